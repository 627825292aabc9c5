"""Locks of two branches made one: by the rule, and by git."""

import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mindlang.lock import Entry, Lock, LockError, lock_text, merge, read_lock, write_lock
from mindlang.lock.training_world import TrainingWorld
from tests.draws import cases
from tests.lint.minds import WORLD
from tests.lock.test_lock import ENTRIES

SKILLS = ("Avoid", "Drive", "Go", "Seek")
WORLDS = st.integers(1, 4).map(lambda ticks: TrainingWorld({**WORLD.facts, "tick": 1 / ticks}))
TAUGHT = st.builds(
    lambda entry, worlds: replace(entry, worlds=tuple(worlds)), ENTRIES, st.lists(WORLDS, min_size=1, max_size=2)
)
MAIN = "from mindlang.cli import main; main()"
DRIVER = f"{sys.executable} -c '{MAIN}' lock merge %O %A %B --name=%P"


def trained(skills: tuple[str, ...] = SKILLS) -> st.SearchStrategy[dict[str, Entry | None]]:
    """What a branch has done to some of the skills: taught them, or forgotten them."""
    chosen = st.dictionaries(st.sampled_from(skills), st.none() | TAUGHT | TAUGHT, max_size=3)
    return chosen.map(lambda found: {skill: entry and replace(entry, skill=skill) for skill, entry in found.items()})


def after(lock: Lock, done: Mapping[str, Entry | None]) -> dict[str, Entry]:
    return {skill: entry for skill, entry in {**lock, **done}.items() if entry}


@given(trained(), trained(), trained())
@settings(max_examples=cases(200), deadline=None)
def test_each_branch_keeps_what_it_has_taught(tmp_path_factory: pytest.TempPathFactory, first, own, other) -> None:
    path = tmp_path_factory.mktemp("merged") / "m.lock"
    base = after({}, first)
    ours, theirs = after(base, own), after(base, other)
    found = merge(base, ours, theirs)
    path.write_text(found.text())
    for skill in SKILLS:
        before, mine, yours = (lock.get(skill) for lock in (base, ours, theirs))
        one_sided = mine if mine != before else yours
        assert (skill in found.conflicts) == (before not in (mine, yours) and mine != yours)
        assert skill in found.conflicts or found.entries.get(skill) == one_sided
    if not found.conflicts:
        assert path.read_text() == lock_text(found.entries)
        assert read_lock(path) == found.entries
        return
    with pytest.raises(LockError, match=r"m\.lock:\d+ stands where two branches"):
        read_lock(path)
    for side, taught in enumerate((ours, theirs)):
        path.write_text(resolved(found.text(), side))
        mine = {skill: taught[skill] for skill in found.conflicts if skill in taught}
        assert read_lock(path) == {**found.entries, **mine}


def resolved(text: str, side: int) -> str:
    """A lock in which one side of every conflict is kept, as a person does it."""
    lines, within = list[str](), -1
    for line in text.splitlines():
        if line[:7] in ("<" * 7, "=" * 7, ">" * 7):
            within = {"<": 0, "=": 1, ">": -1}[line[0]]
        elif within in (-1, side):
            lines.append(line)
    return "\n".join([*lines, ""])


def git(folder: Path, *words: str) -> int:
    """What git says with its exit code."""
    who = ("-c", "user.name=a", "-c", "user.email=a@b", "-c", f"merge.mind.driver={DRIVER}")
    return subprocess.run(("git", *who, *words), cwd=folder, capture_output=True, check=False).returncode


def branches(folder: Path, base: Lock, ours: Lock, theirs: Lock) -> int:
    """Two branches that each wrote a lock, merged; git's exit code."""
    git(folder, "init", "-b", "main")
    (folder / ".gitattributes").write_text("*.lock merge=mind\n")
    path = folder / "a mind.lock"
    for branch, lock in (("main", base), ("ours", ours), ("theirs", theirs)):
        git(folder, "checkout", "-b", branch, "main")
        if lock:
            write_lock(path, lock)
        git(folder, "add", "-A")
        git(folder, "commit", "--allow-empty", "-m", branch)
    git(folder, "checkout", "ours")
    return git(folder, "merge", "theirs")


def entry(skill: str, weights: str, ticks: int) -> Entry:
    text = (
        f"{skill} is mlp hidden 1 | reads eye | sends left_wheel | weights {weights * 32} | task T master {skill}"
        " generations 1 population 9 seed 1 score 1.0"
    )
    found = Entry.of(text, Path())
    assert found
    return replace(found, worlds=(TrainingWorld({**WORLD.facts, "tick": 1 / ticks}),))


@pytest.mark.parametrize("base", [{}, {"Avoid": entry("Avoid", "aa", 1)}])
def test_git_merges_two_trainings(tmp_path: Path, base: Lock) -> None:
    ours, theirs = {**base, "Go": entry("Go", "bb", 2)}, {**base, "Seek": entry("Seek", "cc", 3)}
    assert branches(tmp_path, base, ours, theirs) == 0
    assert read_lock(tmp_path / "a mind.lock") == {**ours, **theirs}


def test_git_is_told_that_both_taught_the_same(tmp_path: Path) -> None:
    base = {"Go": entry("Go", "aa", 1)}
    path = tmp_path / "a mind.lock"
    assert branches(tmp_path, base, {"Go": entry("Go", "bb", 2)}, {"Go": entry("Go", "cc", 3)}) == 1
    assert [line[:7] for line in path.read_text().splitlines()[1:6]] == [
        "<" * 7,
        "Go is m",
        "=" * 7,
        "Go is m",
        ">" * 7,
    ]
    path.write_text(resolved(path.read_text(), 1))
    assert read_lock(path) == {"Go": entry("Go", "cc", 3)}
