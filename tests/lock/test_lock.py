"""The lock as text: there and back, and refused when it is damaged."""

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mindlang.lock import HEADER, Entry, LockError, Signature, Taught, read_lock, read_locks, write_lock
from mindlang.lock.training_world import TrainingWorld
from tests.draws import cases
from tests.lint.minds import WORLD

NAMES = st.text("abcxyzABC_+:0123456789", min_size=1, max_size=8)
HASHES = st.text("0123456789abcdef", min_size=64, max_size=64)
COUNTS = st.integers(0, 10**12)
PLACES = st.just((0, "")) | st.tuples(st.integers(1, 10**9 - 1), NAMES)
ENTRIES = st.builds(
    Entry,
    NAMES,
    st.builds(
        Signature,
        st.sampled_from(["mlp hidden 2 width 14", "neat"]),
        st.lists(NAMES, min_size=1, max_size=4).map(tuple),
        st.lists(NAMES | st.sampled_from(["sends", "reads", "with"]), min_size=1, max_size=4).map(tuple),
    ),
    HASHES,
    st.builds(
        lambda place, success, happened, *said: Taught(*said, *place, success, happened),
        *(PLACES, st.none() | st.integers(0, 50).map(lambda runs: runs / 50)),
        st.sampled_from(["", "0.02 reach of ball", "12.5 visit patch 4.0, 3.0 leave of ring by foe"]),
        *(NAMES, NAMES, st.booleans(), COUNTS, COUNTS, COUNTS),
        st.floats(allow_nan=False, allow_infinity=False),
    ),
    st.lists(st.tuples(NAMES, HASHES), max_size=3).map(tuple),
    st.just((WORLD,)),
)
BARE = (
    "Avoid is mlp hidden 2 width 14 | reads proximity:10 moving pulse | sends left_wheel right_wheel"
    f" | weights {'ab' * 32} | task Avoid master Avoid generations 1000 population 100 seed 3 score 812.4"
)
LINE = f"{BARE} | taught in {WORLD.name}"
WORLDS = {WORLD.name: WORLD}


@given(st.lists(ENTRIES, max_size=5, unique_by=lambda entry: entry.skill))
def test_there_and_back(tmp_path_factory: pytest.TempPathFactory, entries: list[Entry]) -> None:
    path = tmp_path_factory.mktemp("lock") / "a.lock"
    write_lock(path, {entry.skill: entry for entry in entries})
    back = read_lock(path)
    assert back == {entry.skill: entry for entry in entries}
    assert list(back) == sorted(back)
    text = path.read_bytes()
    write_lock(path, back)
    assert path.read_bytes() == text


def test_a_line_reads_like_a_sentence() -> None:
    entry = Entry.of(LINE, Path(), WORLDS)
    assert entry is not None
    assert entry.signature == Signature(
        "mlp hidden 2 width 14", ("proximity:10", "moving", "pulse"), ("left_wheel", "right_wheel")
    )
    assert entry.taught == Taught("Avoid", "Avoid", False, 1000, 100, 3, 812.4)
    assert str(entry) == LINE


def test_no_lock_has_no_entries(tmp_path: Path) -> None:
    assert read_lock(tmp_path / "a.lock") == {}


def test_a_file_knows_what_the_files_that_it_uses_have_learnt(tmp_path: Path) -> None:
    own = Entry.of(LINE, tmp_path, WORLDS)
    used = Entry.of(LINE.replace("ab" * 32, "cd" * 32), tmp_path, WORLDS)
    other = Entry.of(LINE.replace("Avoid is", "Go is"), tmp_path, WORLDS)
    assert own
    assert used
    assert other
    write_lock(tmp_path / "power.lock", {"Avoid": own})
    write_lock(tmp_path / "collect.lock", {"Avoid": used, "Go": other})
    assert read_locks([tmp_path / "power.mind", tmp_path / "collect.mind"]) == {"Avoid": own, "Go": other}


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda text: "", "is damaged: it is not a whole lock"),
        (lambda text: text[:-1], "is damaged: it is not a whole lock"),
        (lambda text: text.replace("lock 5", "lock 6"), "is damaged: it is not a whole lock"),
        (lambda text: text.replace("\n\n", "\n\nx\n"), "a.lock:4 is damaged: this is not what mindc wrote"),
        (lambda text: text.replace("abab", "abax"), "a.lock:2 is damaged: this is not what mindc wrote"),
        (lambda text: text.replace("\n\n", f"\n{LINE}\n\n"), "a.lock:3 is damaged: Avoid has two lines"),
        (lambda text: text.replace("Avoid is", "<<<<<<< HEAD\nAvoid is"), "a.lock:2 stands where two branches"),
        (lambda text: "<<<<<<< HEAD\n" + text, "a.lock:1 stands where two branches"),
        (lambda text: text + "x | " * 300_000, "is damaged"),
        (lambda text: text.replace("lock 5", "lock 3"), "a.lock is a lock of before mindlang 0.1.0"),
        (lambda text: text.replace(LINE, BARE), "a.lock is a lock of before mindlang 0.1.0"),
    ],
)
def test_a_damaged_lock_is_refused(tmp_path: Path, damage, message: str) -> None:
    path = tmp_path / "a.lock"
    entry = Entry.of(LINE, tmp_path, WORLDS)
    assert entry
    write_lock(path, {"Avoid": entry})
    path.write_text(damage(path.read_text()))
    with pytest.raises(LockError, match=message):
        read_lock(path)


def test_blank_lines_mean_nothing(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    entry = Entry.of(LINE, tmp_path, WORLDS)
    assert entry
    entry = replace(entry, worlds=(WORLD, TrainingWorld({**WORLD.facts, "tick": 1.0})))
    write_lock(path, {"Avoid": entry})
    path.write_text(path.read_text().replace("\n", "\n\n"))
    assert read_lock(path) == {"Avoid": entry}


def test_what_is_said_of_a_damaged_lock_commands_no_terminal(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    path.write_text(f"{HEADER}\n\nworld 0123456789abcdef\n  \x1b[2J Go = 1\n")
    with pytest.raises(LockError, match=r"u001b\[2J Go cannot be so") as error:
        read_lock(path)
    assert str(error.value).isprintable()


@pytest.mark.parametrize("data", [b"\xff\xfe", b"\0" * 100, b"# mind lock 1: \xff\n"])
def test_other_bytes_are_refused(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "a.lock").write_bytes(data)
    with pytest.raises(LockError, match=r"a\.lock"):
        read_lock(tmp_path / "a.lock")


@given(st.data())
@settings(max_examples=cases(200))
def test_no_change_of_a_character_is_a_crash(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    place = data.draw(st.integers(0, len(BARE)))
    changed = BARE[:place] + data.draw(st.text(max_size=3)) + BARE[place + data.draw(st.integers(0, 3)) :]
    entry = Entry.of(changed, Path())
    assert entry is None or str(entry).split() == changed.split() or float(changed.split()[-1]) == entry.taught.score
