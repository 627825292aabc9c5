"""What two minds differ in: nothing for another spelling, one line for one changed number."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mindlang.compiler.comparison import MindDifference, mind_differences
from mindlang.compiler.compile import compile_source
from mindlang.compiler.model import Mind
from mindlang.compiler.source import Source
from mindlang.compiler.syntax import NOUNS, SETTINGS
from tests.calling import RULES
from tests.draws import cases
from tests.edits.sources import Texts, minds
from tests.language.examples import COLLECT, compiled

LESSONS = """
curriculum School is genetic population 100 elite 2%
  teaches Learn on Chase for 5 generations
  teaches Learn on Roam for 5 generations
  teaches Learn on Chase for 5 generations
skill Learn is mlp hidden 2
  reads feeler
  reads ball_bearing
  drives left_wheel
  drives right_wheel
"""
TEXT = RULES + LESSONS


def mind(text: str) -> Mind:
    found = compiled(text)
    assert found.mind, found.diagnostics
    return found.mind


def changed(*pairs: tuple[str, str]) -> list[MindDifference]:
    """The differences after some of the text has been replaced, everywhere."""
    text = TEXT
    for before, after in pairs:
        assert before in text
        text = text.replace(before, after)
    return mind_differences(mind(TEXT), mind(text))


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("reads feeler\n", "reads   feeler  # a comment\n\n"),
        ("neutral 0.5", "neutral 50%"),
        ("at 0.2", "at 20%"),
        ("at 0.2", "at 1/5"),
        ("at 0.2", "at 0.20"),
        ("at 0.9", "at (0.9)"),
        ("at 0 30 330 deg", "range 12 at 0 deg 30 deg 330 deg"),
        ("side left neutral 0.5", "neutral 0.5 side left"),
        ("is mlp hidden 2", "is mlp"),
        ("is disc\n", "is disc size 2\n"),
        ("genetic population 100 elite 2%", "genetic elite 2% population 100"),
        ("on Chase for 5 generations", "on Chase under Learn for 5 generations"),
        ("for 5 generations\n", "for 5 generations population 100\n"),
        ("lasts 1200 ticks", "lasts 20 s"),
        ("size 2 to 3", "size 2 to 3 jitter 0"),
        ("  reads feeler\n  reads ball_bearing\n", "  reads ball_bearing\n  reads feeler\n"),
        ("  influences Chase at 1\n  influences Turn at 0.2\n", "  influences Turn at 0.2\n  influences Chase at 1\n"),
    ],
)
def test_another_spelling_is_no_difference(before: str, after: str) -> None:
    assert changed((before, after)) == []


@pytest.mark.parametrize(
    ("before", "after", "what"),
    [
        ("influences Turn at 0.2", "influences Turn at 0.3", "skill Roam"),
        ("drives left_wheel at 0.9", "drives left_wheel at 1 - 0.1", "skill Turn"),
        ("skill Learn is mlp hidden 2", "skill Learn is mlp hidden 3", "skill Learn"),
        ("contains rock is obstacle grid 10 size 2 to 3", "contains rock is obstacle grid 11 size 2 to 3", "task Roam"),
        ("lasts 1200 ticks", "lasts 21 s", "task Chase"),
        ("rewards -5 on collision", "rewards -6 on collision", "task Roam"),
        ("ends on collision", "ends on reach of ball", "task Roam"),
        (
            "sensor feeler is range_finder at 0 30 330 deg",
            "sensor feeler is range_finder at 30 0 330 deg",
            "sensor feeler",
        ),
        ("genetic population 100 elite 2%", "genetic population 90 elite 2%", "curriculum School"),
        ("wheel side left neutral 0.5", "wheel side left neutral 0.5 thrust 9", "actuator left_wheel"),
        ("master Roam", "master Chase", "master"),
    ],
)
def test_one_change_is_one_difference(before: str, after: str, what: str) -> None:
    gone = next(line.strip() for line in TEXT.splitlines() if before in line)
    assert changed((before, after)) == [MindDifference(what, (gone,), (gone.replace(before, after),))]


def test_another_tick_is_one_difference() -> None:
    assert changed(("tick 1/60 s", "tick 1/50 s")) == [MindDifference("tick", ("tick 0.0166667 s",), ("tick 0.02 s",))]


def test_what_is_new_and_what_is_gone_has_all_its_lines() -> None:
    new = "skill New is rule\n  drives left_wheel at 1 # fast\n"
    found = mind_differences(mind(TEXT), mind(TEXT + new))
    assert found == [MindDifference("skill New", (), ("skill New is rule", "drives left_wheel at 1"))]
    assert mind_differences(mind(TEXT + new), mind(TEXT)) == [MindDifference("skill New", found[0].new, ())]


def test_what_is_said_twice_counts_twice() -> None:
    reward = "  rewards 10 on reach of ball\n"
    assert changed((reward, reward * 2)) == [MindDifference("task Chase", (), ("rewards 10 on reach of ball",))]


def test_the_order_of_lessons_is_a_difference() -> None:
    one, other = "  teaches Learn on Chase for 5 generations\n", "  teaches Learn on Roam for 5 generations\n"
    assert changed((one + other + one, other + one + one)) == [
        MindDifference("curriculum School", (other.strip(),), (other.strip(),))
    ]


def test_where_a_declaration_stands_is_no_difference() -> None:
    text = COLLECT.read_text(encoding="utf-8")
    paragraphs = text.split("\n\n")
    assert mind_differences(mind(text), mind("\n\n".join([*paragraphs[:2], *reversed(paragraphs[2:])]))) == []


OPEN_WORLD = """tick 1/60 s
master Go
unit 8.5 cm
number sight is 12
body Robot is disc
actuator left is wheel side left neutral 0.5
sensor eye is range_finder at 0 deg range sight
sensor battery is battery drain 0.003 per s
skill Seek is mlp
  reads eye
  drives left when eye > 0.5 otherwise 0.2
skill Go is rule
  reads eye
  influences Seek at eye cuts below 5%
scene Flat is arena size 50
  starts at 0 0 facing 90 deg
  varies thrust of left 60 to 90
  fails left 1% per s
task Run in Flat
  lasts 1000 ticks
  ends when battery < 5%
  succeeds when eye < 0.1
"""


@pytest.mark.parametrize(
    ("what", "gone", "new"),
    [
        ("unit", "unit 8.5 cm", "unit 9 cm"),
        ("unit", "unit 8.5 cm", ""),
        ("number sight", "number sight is 12", "number sight is 13"),
        ("sensor battery", "sensor battery is battery drain 0.003 per s", "sensor battery is battery drain 0.003"),
        ("skill Seek", "drives left when eye > 0.5 otherwise 0.2", "drives left when eye >= 0.5 otherwise 0.2"),
        ("skill Seek", "drives left when eye > 0.5 otherwise 0.2", "drives left when eye > 0.5 otherwise 0.3"),
        ("skill Seek", "drives left when eye > 0.5 otherwise 0.2", "drives left when eye > 0.5"),
        ("skill Seek", "drives left when eye > 0.5 otherwise 0.2", "drives left"),
        ("skill Go", "influences Seek at eye cuts below 5%", "influences Seek at eye cuts below 6%"),
        ("skill Go", "influences Seek at eye cuts below 5%", "influences Seek at eye"),
        ("skill Go", "influences Seek at eye cuts below 5%", "influences Seek over left at eye cuts below 5%"),
        ("task Run", "starts at 0 0 facing 90 deg", "starts at 0 1 facing 90 deg"),
        ("task Run", "starts at 0 0 facing 90 deg", "starts facing 90 deg"),
        ("task Run", "starts at 0 0 facing 90 deg", ""),
        ("task Run", "varies thrust of left 60 to 90", "varies thrust of left 60 to 80"),
        ("task Run", "varies thrust of left 60 to 90", ""),
        ("task Run", "fails left 1% per s", "fails left 2% per s"),
        ("task Run", "fails left 1% per s", ""),
        ("task Run", "ends when battery < 5%", "ends when battery < 6%"),
        ("task Run", "ends when battery < 5%", ""),
        ("task Run", "succeeds when eye < 0.1", "ends when eye < 0.1"),
    ],
)
def test_words_of_the_open_world_are_differences(what: str, gone: str, new: str) -> None:
    found = mind_differences(mind(OPEN_WORLD), mind(OPEN_WORLD.replace(gone, new)))
    assert found == [MindDifference(what, (gone,), (new,) if new else ())]
    assert mind_differences(mind(OPEN_WORLD.replace(gone, new)), mind(OPEN_WORLD)) == [
        MindDifference(what, found[0].new, (gone,))
    ]


def test_another_scene_is_a_difference_of_its_tasks() -> None:
    larger = OPEN_WORLD.replace("scene Flat is arena size 50", "scene Flat is arena size 60")
    headers = ("task Run in arena size 50",), ("task Run in arena size 60",)
    assert mind_differences(mind(OPEN_WORLD), mind(larger)) == [MindDifference("task Run", *headers)]


def test_a_map_drawn_otherwise_is_a_difference(tmp_path: Path) -> None:
    text = TEXT.replace("  contains rock is", '  contains maze is map from "maze.txt"\n  contains rock is')
    minds_ = []
    for drawing in ("#..#\n....\n#..#\n", "#..#\n.#..\n#..#\n"):
        (tmp_path / "maze.txt").write_text(drawing)
        minds_.append(compile_source(Source("a.mind", text, tmp_path)).mind)
    assert minds_[0]
    assert minds_[1]
    assert mind_differences(*minds_) == [MindDifference("map maze.txt", ("....",), (".#..",))]


@given(minds(), st.randoms(use_true_random=False))
@settings(max_examples=cases(40))
def test_a_mind_written_otherwise_is_the_same(texts: Texts, rng) -> None:
    """Without comments and blank lines, with other line ends and its declarations in another order.

    Things that one sensor is about stand side by side: where there may be some, the lines of things keep their order.
    """
    both = "\n".join(texts.files.values()).replace('use "parts.mind"', "")
    blocks: list[list[str]] = []
    for line in filter(None, (line.partition("#")[0].strip() for line in both.splitlines())):
        if line.split()[0] in (*NOUNS, *SETTINGS):
            blocks.append([])
        blocks[-1].append(line)
    settings_, declared = blocks[:2], blocks[2:]
    rng.shuffle(declared)
    for block in declared:
        if not block[0].startswith("curriculum"):
            things = iter([line for line in block if line.startswith("contains") and " or " in both])
            some = rng.sample(block[1:], len(block) - 1)
            block[1:] = [next(things, line) if line.startswith("contains") else line for line in some]
    text = "\r\n".join(line for block in [*settings_, *declared] for line in block)
    before = texts.compiled().mind
    assert before
    assert mind_differences(before, mind(text)) == []
    assert mind_differences(mind(text), before) == []
