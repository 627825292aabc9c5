"""A file that is used under a name: what it declares has that name before its own, and its own lines mean that."""

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import assume, given

from mindlang.compiler.compile import Compiled, compile_source, load
from mindlang.compiler.source import Source
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits.hierarchy import disconnect
from mindlang.editing.edits.rename import rename
from mindlang.editing.project import EditError, open_project
from mindlang.lock import lock_sources
from tests.edits.sources import Texts, minds

WALLS = """\
tick 1/60 s
master Grab
number far is 12
number half is -far
body Robot is disc size 2
actuator left is wheel side left neutral 0.5
sensor proximity is range_finder at 0 deg range far
memory mood is cell decay 0.9
scene Rocks is arena size 60
  contains rock is obstacle count 5
  contains mood is item
skill Grab is rule
  reads proximity
  reads elsewhere
  drives left at proximity * far / 24 + mood
  drives mood at 1
  reads mood
task Grab in Rocks
  lasts 5 s
  rewards far * mood per tick for each mood in proximity
  rewards 1 on reach of mood
"""
MAIN = """\
use "walls.mind" as walls
master Go
sensor elsewhere is clock period 1 s
skill Go is rule
  reads walls.proximity
  influences walls.Grab at walls.proximity * walls.far / 12
skill Grab is rule
  drives walls.left at 1
task Grab is like walls.Grab
  lasts 6 s
task In in walls.Rocks
  lasts 6 s
"""


def laid_out(folder: Path, **texts: str) -> Compiled:
    for name, text in texts.items():
        (folder / f"{name}.mind").write_text(text)
    return load(folder / "main.mind")


def test_a_file_keeps_its_own_names_below_its_alias(tmp_path: Path) -> None:
    graph = laid_out(tmp_path, main=MAIN, walls=WALLS).graph
    assert graph
    assert [skill.name for skill in graph.skills] == ["Go", "Grab", "walls.Grab"]
    assert [sensor.name for sensor in graph.sensors] == ["elsewhere", "walls.proximity"]
    assert [task.name for task in graph.tasks] == ["Grab", "In", "walls.Grab"]
    walls = graph.tasks[-1]
    assert [thing.name for thing in walls.things] == ["rock", "mood"]
    assert walls.rewards[0].amount == (("number", 12.0), ("each", 0), ("*", 0))


@given(minds())
def test_under_a_name_everything_is_called_otherwise_and_is_the_same(texts: Texts) -> None:
    assume(len(texts.files) == 1)  # what others declare keeps its name
    [main] = texts.files
    before = texts.compiled().graph
    assert before
    over = f'use "used.mind" as under\nmaster under.{before.master}\n'
    files = {main: over, main.with_name("used.mind"): texts.files[main]}
    after = compile_source(Source(main.name, over, main.parent), main, files).graph
    assert after
    assert after.skills == tuple(
        replace(skill, name=f"under.{skill.name}", like=skill.like and f"under.{skill.like}") for skill in before.skills
    )


def test_two_files_with_one_name_stay_apart(tmp_path: Path) -> None:
    other = "skill Grab is rule\n  drives walls.left at 0\n"
    both = MAIN.replace('use "', 'use "other.mind" as other\nuse "', 1)
    graph = laid_out(tmp_path, main=both, walls=WALLS, other=other).graph
    assert graph
    assert {"other.Grab", "walls.Grab", "Grab"} < {skill.name for skill in graph.skills}


def test_one_file_has_one_name(tmp_path: Path) -> None:
    twice = laid_out(tmp_path, main=MAIN.replace("master", 'use "walls.mind"\nmaster', 1), walls=WALLS)
    assert [found.code for found in twice.diagnostics] == ["other-alias"]


def test_one_name_has_one_file(tmp_path: Path) -> None:
    both = MAIN.replace('use "', 'use "other.mind" as walls\nuse "', 1)
    twice = laid_out(tmp_path, main=both, walls=WALLS, other="number far is 12\n")
    assert [found.code for found in twice.diagnostics] == ["taken-alias"]


def test_a_mistake_in_it_stands_on_its_line(tmp_path: Path) -> None:
    wrong = laid_out(tmp_path, main=MAIN, walls=WALLS.replace("reads elsewhere", "reads proximty"))
    assert [(found.code, found.span and (found.span.source.name, found.span.line)) for found in wrong.diagnostics] == [
        ("unknown-sensor", (str(tmp_path / "walls.mind"), 14))
    ]


def test_its_lock_is_of_other_skills(tmp_path: Path) -> None:
    assert lock_sources(laid_out(tmp_path, main=MAIN, walls=WALLS).sources) == [tmp_path / "main.mind"]


@pytest.mark.parametrize(
    ("noun", "old", "new"),
    [
        ("skill", "Grab", "Pick"),
        ("number", "far", "wide"),
        ("scene", "Rocks", "Stones"),
        ("sensor", "proximity", "near_by"),
    ],
)
def test_a_rename_in_the_file_is_followed_by_who_uses_it(tmp_path: Path, noun: str, old: str, new: str) -> None:
    alone = WALLS.replace("  reads elsewhere\n", "")
    before = laid_out(tmp_path, main=MAIN, walls=alone).graph
    assert before
    project = open_project(load(tmp_path / "walls.mind"))
    texts = apply_edit(project, rename(project, old, new, noun=noun), keep_weights=False).texts
    for path, text in texts.items():
        path.write_text(text)
    after = load(tmp_path / "main.mind")
    assert after.graph, after.diagnostics
    assert f"walls.{new}" in (tmp_path / "main.mind").read_text()
    assert f"walls.{old}" not in (tmp_path / "main.mind").read_text().replace(f"like walls.{old}", "")
    assert f"{noun} {new} " in (tmp_path / "walls.mind").read_text()


@pytest.mark.parametrize(
    ("walls", "old", "noun", "hint"),
    [
        (WALLS.replace("  reads elsewhere\n", ""), "walls.far", "number",
         "Rename it there, and it is followed here: mindc edit rename {walls} far wide --noun number"),
        (WALLS, "walls.far", "number",
         "{walls} is no mind by itself, so do it by hand: call far wide there, and walls.far walls.wide here."),
        (WALLS, "rock", "",
         "{walls} is no mind by itself, so do it by hand: call rock wide there, and rock wide here."),
    ],
)  # fmt: skip
def test_it_is_not_renamed_from_outside(tmp_path: Path, walls: str, old: str, noun: str, hint: str) -> None:
    project = open_project(laid_out(tmp_path, main=MAIN, walls=walls))
    with pytest.raises(EditError, match="is used as walls") as found:
        rename(project, old, "walls.wide", noun=noun)
    assert found.value.hint == hint.format(walls=tmp_path / "walls.mind")


def test_it_is_not_edited_from_outside(tmp_path: Path) -> None:
    for walls, hint in ((WALLS, "by hand"), (WALLS.replace("  reads elsewhere\n", ""), "mindc edit … ")):
        project = open_project(laid_out(tmp_path, main=MAIN, walls=walls))
        with pytest.raises(EditError, match="is used as walls") as found:
            apply_edit(project, disconnect(project, "walls.Grab", "walls.left"), keep_weights=False)
        assert hint in found.value.hint
