"""`mindc weights import` and `export`, as their users call them."""

import json
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from mindlang.compiler.compile import load
from mindlang.lock import Taught, lock_path, read_lock
from mindlang.training.lock_update import compare_genomes
from mindlang.training.subject import open_subject
from mindlang.weights.importing import Trial, open_trial
from tests.calling import Call
from tests.edits.taught import MIND, teach, write_mind

TASK = MIND.replace("  rewards 10 on reach of ball\n", "  rewards progress toward ball per tick\n")


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A mind of which all has been taught, as a file in the working folder."""
    monkeypatch.chdir(tmp_path)
    found = write_mind(tmp_path, TASK)
    teach(found)
    return found


def snapshot(folder: Path) -> dict[str, bytes]:
    """All files of a folder."""
    return {str(each): each.read_bytes() for each in sorted(folder.rglob("*")) if each.is_file()}


def changed(path: Path, seed: int = 5) -> Path:
    """Weights of Go that are others than those that were taught."""
    data = bytearray(path.read_bytes())
    data[-8:] = np.random.default_rng(seed).random(2).astype("<f4").tobytes()
    path.write_bytes(data)
    return path


def test_there_and_back_is_the_same_to_the_bit(mindc: Call, path: Path) -> None:
    assert mindc("weights", "export", path, "Go", "go.safetensors").code == 0
    before = snapshot(path.parent)
    said = mindc("weights", "import", path, "Go", "go.safetensors", "--json")
    assert said.code == 0, said.err
    assert "drive.lock has these weights already, and stays as it is" in said.err
    assert snapshot(path.parent) == before
    data = json.loads(said.out)
    assert (data["kept"], data["score_before"], data["notes"]) == (True, None, [])
    assert data["weights"] == read_lock(lock_path(path))["Go"].weights


def test_the_lock_says_where_weights_are_from(mindc: Call, path: Path) -> None:
    old = read_lock(lock_path(path))["Go"].weights
    mindc("weights", "export", path, "Go", "my go.safetensors")
    changed(Path("my go.safetensors"))
    said = mindc("weights", "import", path, "Go", "my go.safetensors", "--force", "--json")
    assert said.code == 0, said.err
    data, entry = json.loads(said.out), read_lock(lock_path(path))["Go"]
    assert entry.weights == data["weights"] != old
    assert entry.origin == ("file:my%20go.safetensors", data["file_sha256"])
    assert entry.origin_file == "my go.safetensors"
    assert entry.accepted
    assert entry.taught == Taught("Roam", "Go", False, 0, 0, 0, data["score"], 1, "School")
    assert data["difference"] <= (0 if data["reference"] != "float64" else 1e-5)
    assert data == {
        "skill": "Go", "file": "my go.safetensors", "weights": entry.weights, "kept": True, "ticks": 60, "faults": 0,
        "file_sha256": sha256(Path("my go.safetensors").read_bytes()).hexdigest(), "task": "Roam", "master": "Go",
        "notes": [f"Drive was taught elsewhere: taught with another Go ({old[:4]}…, now {entry.weights[:4]}…)"],
        **{measured: data[measured] for measured in ("reference", "difference", "score", "score_before")},
    }  # fmt: skip
    status = mindc("status", path)
    assert status.code == 0
    assert "not taught here, begun as my go.safetensors" in status.out
    assert mindc("run", path, "--json").code == 0


def test_what_does_worse_needs_force(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    kept = [seed for seed in range(12) if _verdict(mindc, path, seed)]
    assert 0 < len(kept) < 12, "some do better than what was there, and some do not"


def _verdict(mindc: Call, path: Path, seed: int) -> bool:
    """Whether weights are taken that are others; where not, nothing changes, and --force is what would."""
    before = snapshot(path.parent / "weights"), lock_path(path).read_bytes()
    said = mindc("weights", "import", path, "Go", changed(Path("go.safetensors"), seed), "--json")
    data = json.loads(said.out)
    assert data["kept"] == (data["score"] >= data["score_before"])
    assert said.code == (0 if data["kept"] else 1)
    if not data["kept"]:
        assert "--force takes the new ones all the same" in said.err
        assert (snapshot(path.parent / "weights"), lock_path(path).read_bytes()) == before
    return bool(data["kept"])


def test_an_untaught_skill_has_weights_then(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    taught = read_lock(lock_path(path))["Go"].weights
    lock_path(path).unlink()
    said = mindc("weights", "import", path, "Go", "go.safetensors")
    assert said.code == 0, said.err
    assert read_lock(lock_path(path))["Go"].weights == taught
    assert [line.split()[:2] for line in mindc("status", path).out.splitlines()][2] == ["Go", "trained"]


def test_a_skill_that_remembers(mindc: Call, path: Path) -> None:
    path.write_text(TASK.replace("skill Go is mlp hidden 1", "skill Go is elman"))
    teach(path, "Go")
    mindc("weights", "export", path, "Go", "go.safetensors")
    changed(Path("go.safetensors"))
    said = mindc("weights", "import", path, "Go", "go.safetensors", "--force", "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["difference"] <= 1e-5


def trial_of(path: Path, skill: str) -> Trial:
    """The trial of weights that stand in a file of the skill's name."""
    subject = open_subject(path, load(path))
    return open_trial(subject, skill, Path(f"{skill}.safetensors"))


def test_weights_are_tried_as_those_that_were_taught(mindc: Call, path: Path) -> None:
    """On the first of all runs, which can be recorded, and on the layouts of a training with the seed 0."""
    mindc("weights", "export", path, "Drive", "Drive.safetensors")
    trial = trial_of(path, "Drive")
    genome = trial.genome
    assert mindc("run", path, "--master", "Drive", "--seed", 1, "--record", "day.rec").code == 0
    assert np.array_equal(trial.recorded("day.rec"), trial.readings())
    assert len({column.tobytes() for column in trial.readings().T}) > 1, "which is which is seen"
    run = SimpleNamespace(manifest=SimpleNamespace(seed=0, lesson=trial.lesson))
    found = compare_genomes(run, trial.rollout, np.stack([genome, genome / 2]))  # type: ignore[arg-type]
    assert replace(trial, genome=genome / 2).score(genome) == (found.new, found)
    assert trial.score(None) == (found.old, None)


def test_only_those_are_told_of_whom_something_changes(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    path.write_text(path.read_text().replace("item size 2", "item size 3"))
    assert "Drive, Avoid and Go were taught elsewhere" in mindc("run", path).err
    said = mindc("weights", "import", path, "Go", changed(Path("go.safetensors")), "--force", "--json")
    [note] = json.loads(said.out)["notes"]
    assert note.startswith("Drive was taught elsewhere: taught with another Go")


def test_weights_without_a_score_are_not_taken(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    path.write_text(path.read_text().replace("progress toward ball", "1 / (charge - charge)"))
    before = lock_path(path).read_bytes()
    said = mindc("weights", "import", path, "Go", changed(Path("go.safetensors")), "--force")
    assert (said.code, lock_path(path).read_bytes()) == (1, before)
    assert "Go with these weights: a reward or a command was not a finite number" in said.err


def test_readings_of_a_recording(mindc: Call, path: Path) -> None:
    assert mindc("run", path, "--master", "Go", "--record", "day.rec").code == 0
    mindc("weights", "export", path, "Go", "go.safetensors")
    said = mindc("weights", "import", path, "Go", "go.safetensors", "--recording", "day.rec", "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["ticks"] == 60
    mindc("weights", "export", path, "Avoid", "avoid.safetensors")
    said = mindc("weights", "import", path, "Avoid", "avoid.safetensors", "--recording", "day.rec")
    assert (said.code, "day.rec has no readings of eye" in said.err) == (1, True)


REFUSED: dict[str, tuple[tuple[str, ...], int, str]] = {
    "no such skill": (("import", "drive.mind", "Gone", "go.safetensors"), 1, "there is no skill called Gone"),
    "a rule": (("export", "drive.mind", "Grab", "a.safetensors"), 1, "Grab has no weights: it learns nothing"),
    "no file": (("import", "drive.mind", "Go", "none.safetensors"), 1, "none.safetensors cannot be read"),
    "a folder": (("import", "drive.mind", "Go", "weights"), 1, "weights cannot be read: it is a folder"),
    "weights of another": (("import", "drive.mind", "Avoid", "go.safetensors"), 1, "go.safetensors: it has no layers"),
    "no safetensors": (("import", "drive.mind", "Go", "drive.mind"), 1, "that can be read: header too large"),
    "no recording": (
        ("import", "drive.mind", "Go", "go.safetensors", "--recording", "none.rec"), 1, "none.rec",
    ),
    "another suffix": (("export", "drive.mind", "Go", "go.npz"), 2, "go.npz must end in .safetensors"),
    "standard input": (("export", "-", "Go", "a.safetensors"), 2, "standard input is none"),
    "no such command": (("imprt", "drive.mind"), 2, "There is no command called 'imprt'"),
}  # fmt: skip


@pytest.mark.parametrize(("words", "code", "message"), REFUSED.values(), ids=REFUSED)
def test_a_mistake_is_one_sentence_and_changes_nothing(
    mindc: Call, path: Path, words: tuple[str, ...], code: int, message: str
) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    before = snapshot(path.parent)
    said = mindc("weights", *words)
    assert (said.code, said.out) == (code, "")
    assert message in said.err
    assert "Traceback" not in said.err
    assert snapshot(path.parent) == before


def test_weights_cut_off_leave_the_lock_alone(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    whole = Path("go.safetensors").read_bytes()
    before = lock_path(path).read_bytes()
    for size in range(0, len(whole), 37):
        Path("go.safetensors").write_bytes(whole[:size])
        said = mindc("weights", "import", path, "Go", "go.safetensors", "--force")
        assert said.code == 1
        assert "it is no file of safetensors that can be read" in said.err
    assert lock_path(path).read_bytes() == before


def test_a_frozen_skill_stays_as_it_is(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    path.write_text(path.read_text().replace("  # to the ball\n", "\n  stays frozen\n"))
    before = lock_path(path).read_bytes()
    said = mindc("weights", "import", path, "Go", changed(Path("go.safetensors")), "--force")
    assert (said.code, "Go is frozen" in said.err) == (1, True)
    assert "mindc edit unfreeze drive.mind Go --write" in said.err
    assert lock_path(path).read_bytes() == before


def test_a_skill_that_is_like_another_has_none_of_its_own(mindc: Call, path: Path) -> None:
    follow = "skill Follow is like Go\n  reads charge for ball_bearing\n\n"
    path.write_text(path.read_text().replace("skill Grab is rule", f"{follow}skill Grab is rule"))
    for words in (("export", path, "Follow", "a.safetensors"), ("import", path, "Follow", "drive.mind")):
        said = mindc("weights", *words)
        assert (said.code, "Follow is like Go: it has no weights of its own" in said.err) == (1, True), said.err


def test_skills_below_have_to_be_taught_first(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Drive", "drive.safetensors")
    lock_path(path).unlink()
    said = mindc("weights", "import", path, "Drive", "drive.safetensors")
    assert said.code == 1
    assert "Drive cannot be tried on Roam yet: Avoid has not been taught and Go has not been taught" in said.err
    assert "first: mindc train drive.mind Go Avoid" in said.err
    teach(path, "Go")
    said = mindc("weights", "import", path, "Drive", "drive.safetensors")
    assert "Drive cannot be tried on Roam yet: Avoid has not been taught" in said.err
    assert "first: mindc train drive.mind Avoid" in said.err
    said = mindc("weights", "export", path, "Drive", "drive.safetensors")
    assert (said.code, "Drive has not been taught" in said.err) == (1, True)
    assert "mindc train drive.mind Drive" in said.err


def test_a_skill_without_a_lesson_is_refused(mindc: Call, path: Path) -> None:
    mindc("weights", "export", path, "Go", "go.safetensors")
    path.write_text(path.read_text().replace("  teaches Go on Roam for 3 generations\n", ""))
    said = mindc("weights", "import", path, "Go", "go.safetensors")
    assert (said.code, "no lesson teaches Go" in said.err) == (2, True)
