"""Minds that share files with the one that is edited: they follow, or it is said why not."""

import os
from pathlib import Path

import pytest

from mindlang.compiler.compile import load
from mindlang.lock import lock_path, read_lock
from mindlang.lock.status import Trained
from tests.calling import Call
from tests.edits.taught import MIND, statuses, teach, write_mind

BOSS = """\
use "parts/drive.mind"
master Boss
skill Boss is mlp
  reads charge
  influences Drive
  influences Avoid

task Hunt in plain
  contains ball is item size 2
  lasts 9 ticks
  rewards 1 on reach of ball

curriculum Late is genetic population 8
  teaches Boss on Hunt for 3 generations
  teaches Avoid on Hunt for 3 generations
"""


@pytest.fixture
def drive(tmp_path: Path) -> Path:
    (tmp_path / "parts").mkdir()
    path = write_mind(tmp_path / "parts")
    teach(path)
    return path


@pytest.fixture
def boss(drive: Path) -> Path:
    """A mind in the folder above, with an Avoid of its own."""
    path = drive.parents[1] / "boss.mind"
    path.write_text(BOSS)
    teach(path, "Boss", "Avoid", seed=3)
    return path


def fit(path: Path) -> set[str]:
    return {skill for skill, state in statuses(path).items() if isinstance(state, Trained)}


@pytest.mark.parametrize(
    ("noun", "old", "new"),
    [("skill", "Avoid", "Dodge"), ("sensor", "charge", "full"), ("thing", "ball", "cup"), ("skill", "Drive", "Go+On")],
)
def test_a_rename_goes_on_above(mindc: Call, drive: Path, boss: Path, noun: str, old: str, new: str) -> None:
    trained = {new if skill == old else skill for skill in fit(boss)}
    own = read_lock(lock_path(boss))["Avoid"].weights
    said = mindc("edit", "rename", old, new, "--noun", noun, drive, "--write")
    assert said.code == 0, said.err
    assert fit(boss) == trained
    assert old not in boss.read_text().replace(f"{new}", "").split()
    name = new if old == "Avoid" else "Avoid"
    assert read_lock(lock_path(boss))[name].weights == own


def test_a_name_that_a_neighbour_has_is_taken(mindc: Call, drive: Path, boss: Path) -> None:
    said = mindc("edit", "rename", "Go", "Boss", drive, "--noun", "skill", "--write")
    assert said.code == 1
    assert "There is already a skill called Boss." in said.err
    assert "boss.mind:3:7" in said.err


def test_a_name_that_a_neighbour_gives_to_something_else_is_left_alone(mindc: Call, drive: Path) -> None:
    parts = drive.with_name("wheels.mind")
    assert mindc("edit", "split", "wheels.mind", "left_wheel", drive, "--write").code == 0
    other = drive.with_name("other.mind")
    rest = "".join(line for line in MIND.splitlines(keepends=True) if not line.startswith("actuator left_wheel"))
    other.write_text(f'use "{parts.name}"\n{rest}')
    teach(other, seed=5)
    before = other.read_text(), lock_path(other).read_text()
    assert mindc("edit", "rename", "Avoid", "Dodge", drive, "--noun", "skill", "--write").code == 0
    assert (other.read_text(), lock_path(other).read_text()) == before
    assert mindc("edit", "rename", "left_wheel", "port", drive, "--write").code == 0
    assert fit(other) == {"Go", "Avoid", "Drive"}


def test_what_takes_a_place_takes_it_in_the_locks_of_neighbours(mindc: Call, drive: Path, boss: Path) -> None:
    teach(boss, seed=3)  # a Drive of its own, too
    assert mindc("edit", "encapsulate", "Avoid", "Careful", "--reads", "charge", drive, "--write").code == 0
    states = statuses(boss)
    assert isinstance(states["Drive"], Trained), "its line is one of drive.mind, which says Careful now"
    assert isinstance(states["Boss"], Trained), "it goes on influencing Avoid"


def test_weights_of_neighbours_are_widened(mindc: Call, drive: Path, boss: Path) -> None:
    own = read_lock(lock_path(boss))["Avoid"].weights
    said = mindc("edit", "integrate", "Avoid", "--reads", "charge", "--keep-weights", drive, "--write")
    assert said.code == 0, said.err
    assert fit(boss) == {"Boss", "Go", "Avoid", "Drive"}
    assert read_lock(lock_path(boss))["Avoid"].weights != own


def test_what_becomes_stale_in_a_neighbour_is_told(mindc: Call, drive: Path, boss: Path) -> None:
    said = mindc("edit", "integrate", "Avoid", "--reads", "charge", drive)
    assert "Avoid is stale: reads charge is new\n" in said.err
    assert "boss.mind: Avoid is stale: reads charge is new\n" in said.err


def test_a_neighbour_that_would_no_longer_compile(mindc: Call, drive: Path, boss: Path) -> None:
    text = drive.read_text()
    words = ("edit", "remove", "skill", "Grab", drive)
    assert mindc("edit", "disconnect", "Drive", "Grab", drive, "--write").code == 0
    boss.write_text(BOSS.replace("influences Avoid", "influences Grab"))
    said = mindc(*words)
    assert said.code == 0
    assert "boss.mind no longer compiles by itself: There is no skill called Grab." in said.err
    before = drive.read_text()
    said = mindc(*words, "--write")
    assert (said.code, drive.read_text()) == (1, before)
    assert "--anyway" in said.err
    assert mindc(*words, "--write", "--anyway").code == 0
    assert load(boss).graph is None
    assert drive.read_text() != text


def test_what_lies_beside_is_in_nobodys_way(mindc: Call, drive: Path, boss: Path) -> None:
    damaged = lock_path(boss).write_text("<<<<<<< HEAD\n")
    folder = drive.parent
    os.mkfifo(folder / "pipe.mind")
    (folder / "loop.mind").symlink_to(folder / "loop.mind")
    (folder / "folder.mind").mkdir()
    (folder / "junk.mind").write_bytes(b'use "\0')
    said = mindc("edit", "rename", "Avoid", "Dodge", "--noun", "skill", drive, "--write")
    assert said.code == 0, said.err
    assert "boss.lock:1 stands where two branches could not be merged" in said.err
    assert lock_path(boss).stat().st_size == damaged
    assert "Dodge" in boss.read_text()


def test_a_loop_of_links_is_unreadable(mindc: Call, tmp_path: Path) -> None:
    (tmp_path / "loop.mind").symlink_to(tmp_path / "loop.mind")
    said = mindc("status", tmp_path / "loop.mind")
    assert said.code == 2
    assert "cannot be read" in said.err
