"""A lesson has the seeds of its file, whatever that is called, and is another where the file has others."""

from pathlib import Path

from mindrun.graph.codec import decode_part, encode
from mindrun.graph.graph import Lesson

from mindlang.compiler.compile import load
from mindlang.lock.world_facts import hard_words
from tests.falsify.test_search import CAR

SCHOOL = CAR.replace("is rule", "is mlp\n  reads speed").replace("engine at 1", "engine") + (
    'curriculum School is genetic\n  teaches Go on Drive for 9 generations hard 25% of "hard.seeds" layouts 4\n'
)


def lesson(folder: Path, seeds: str) -> Lesson:
    (folder / "hard.seeds").write_text(seeds, encoding="utf-8")
    (folder / "car.mind").write_text(SCHOOL, encoding="utf-8")
    return load(folder / "car.mind").whole[1].lessons[0]


def test_a_lesson_has_the_seeds_of_its_file(tmp_path: Path) -> None:
    found = lesson(tmp_path, f"# three\n{2**64 - 1}\n17  # the worst\n\n3\n17\n")
    assert found.hard is not None
    assert (found.hard.share, found.hard.seeds) == (0.25, ("3", "17", str(2**64 - 1)))
    assert found.learner.layouts == 4
    assert decode_part(Lesson, encode(found), "lesson") == found
    same, other = lesson(tmp_path, f"17\n3\n{2**64 - 1}").hard, lesson(tmp_path, "17\n4").hard
    assert same == found.hard
    assert other is not None
    assert hard_words(found.hard).startswith("25% of 3 layouts ")
    assert hard_words(found.hard) != hard_words(other)
