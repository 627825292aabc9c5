"""`mindc status` and `mindc diff`, as their users call them."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from mindlang.lock import read_lock
from tests.calling import Call
from tests.edits.taught import MIND, teach, write_mind


@pytest.fixture
def drive(tmp_path: Path) -> Path:
    path = write_mind(tmp_path)
    teach(path)
    return path


def test_status_of_what_is_taught(mindc: Call, drive: Path) -> None:
    said = mindc("status", drive)
    lock = read_lock(drive.with_suffix(".lock"))
    made = {
        skill: f"{lock[skill].weights[:4]}…  1.5 on Roam under {skill}, 3 generations of 8 from seed 1"
        for skill in lock
    }
    assert (said.code, said.err) == (0, "")
    assert [line.rstrip().split(None, 2) for line in said.out.splitlines()] == [
        ["Drive", "trained", made["Drive"]],
        ["Avoid", "trained", made["Avoid"]],
        ["Go", "trained", made["Go"]],
        ["Grab", "does", "not learn"],
    ]


def test_status_of_what_is_not(mindc: Call, tmp_path: Path) -> None:
    path = write_mind(tmp_path, MIND.replace("  drives mood\n", "  drives mood\n  stays frozen\n"))
    teach(path, "Avoid", "Drive")
    path.write_text(path.read_text().replace("  reads ball_bearing\n  reads eye\n", "  reads eye\n  reads charge\n"))
    said = mindc("status", path)
    assert said.code == 1
    rows = [" ".join(line.split()) for line in said.out.splitlines()]
    assert rows[:2] == ["Drive stale reads charge is new", "reads ball_bearing is gone"]
    assert rows[2].startswith("Avoid trained, frozen ")
    assert rows[3:] == ["Go untaught", "Grab does not learn"]


def test_status_tells_of_a_subskill_that_was_taught_again(mindc: Call, drive: Path) -> None:
    old = read_lock(drive.with_suffix(".lock"))["Avoid"].weights
    teach(drive, "Avoid", seed=2)
    new = read_lock(drive.with_suffix(".lock"))["Avoid"].weights
    said = mindc("status", drive)
    assert said.code == 0
    assert f"taught with another Avoid ({old[:4]}…, now {new[:4]}…)" in said.out
    assert mindc("run", drive, "--json").code == 0, "nothing is refused"


def test_status_as_json_is_one_document(mindc: Call, drive: Path) -> None:
    said = mindc("status", drive, "--json")
    rows = {row["skill"]: row for row in json.loads(said.out)["skills"]}
    assert list(rows) == ["Drive", "Avoid", "Go", "Grab"]
    assert rows["Grab"] == {
        "skill": "Grab", "status": "does not learn", "frozen": False, "needed": True, "remarks": [],
    }  # fmt: skip
    lock = read_lock(drive.with_suffix(".lock"))
    assert rows["Drive"]["weights"] == lock["Drive"].weights
    assert rows["Drive"]["subskills"] == {"Avoid": lock["Avoid"].weights, "Go": lock["Go"].weights}
    assert rows["Go"]["taught"] == {
        "task": "Roam", "master": "Go", "jointly": False, "generations": 3, "population": 8, "seed": 1, "score": 1.5,
        "number": 0, "curriculum": "", "success": None, "happened": "",
    }  # fmt: skip


def test_a_damaged_lock_is_told(mindc: Call, drive: Path) -> None:
    drive.with_suffix(".lock").write_text("?")
    for arguments in (("status", drive), ("diff", drive, drive), ("edit", "freeze", "Go", drive)):
        said = mindc(*arguments)
        assert (said.code, said.out) == (1, "")
        assert "drive.lock is damaged" in said.err


def test_diff_of_the_same(mindc: Call, drive: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.mind"
    other.write_text(MIND.replace("\n\n", "\n# more\n\n").replace("neutral 0.5", "neutral 50%"))
    said = mindc("diff", drive, other)
    assert (said.code, said.out, said.err) == (0, "weights of Drive, Avoid and Go fit\n", "")
    assert json.loads(mindc("diff", drive, other, "--json").out)["differences"] == []


def test_diff_tells_what_changed_and_what_became_stale(mindc: Call, drive: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.mind"
    other.write_text(
        MIND.replace("influences Grab at 1", "influences Grab at 1/2")
        .replace("mlp hidden 1", "mlp hidden 2")
        .replace("curriculum", "skill New is mlp\n  reads eye\n  drives claw\n\ncurriculum")
    )
    said = mindc("diff", drive, other)
    assert said.code == 1
    assert said.out.splitlines() == [
        "skill Go",
        "  - skill Go is mlp hidden 1",
        "  + skill Go is mlp hidden 2",
        "skill Drive",
        "  - influences Grab at 1",
        "  + influences Grab at 1/2",
        "skill New",
        "  + skill New is mlp",
        "  + reads eye",
        "  + drives claw",
        "weights of Drive and Avoid fit",
        "Drive was taught elsewhere: Drive has changed: sends Grab at 1, now sends Grab at 0.5",
        "Go is stale: hidden was 1, now 2",
        "New has not been taught",
    ]
    data = json.loads(mindc("diff", drive, other, "--json").out)
    assert data["differences"][1] == {
        "what": "skill Drive", "gone": ["influences Grab at 1"], "new": ["influences Grab at 1/2"],
    }  # fmt: skip
    found = [(row["skill"], row["status"]) for row in data["skills"]][:2]
    assert found == [("Drive", "taught elsewhere"), ("Avoid", "trained")]


def test_diff_from_standard_input_uses_the_lock_beside_the_new_file(drive: Path) -> None:
    command = [sys.executable, "-c", "from mindlang.cli import main; main()", "diff", "-", str(drive)]
    text = MIND.replace("decay 0.9", "decay 0.8")
    said = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    assert (said.returncode, said.stderr) == (1, "")
    assert said.stdout.splitlines() == [
        "memory mood",
        "  - memory mood is cell decay 0.8",
        "  + memory mood is cell decay 0.9",
        "weights of Drive, Avoid and Go fit",
    ]


def test_diff_goes_by_the_lock_of_the_new_file_where_it_has_one(mindc: Call, drive: Path, tmp_path: Path) -> None:
    (tmp_path / "old").mkdir()
    old = write_mind(tmp_path / "old")
    teach(old)
    assert mindc("edit", "rename", "Avoid", "Dodge", "--noun", "skill", drive, "--write").code == 0
    said = mindc("diff", old, drive)
    assert said.out.splitlines()[-1] == "weights of Drive, Dodge and Go fit"


def test_what_cannot_be_read(mindc: Call, drive: Path, tmp_path: Path) -> None:
    assert mindc("diff", drive, tmp_path / "none.mind").code == 2
    assert mindc("status", tmp_path / "none.mind").code == 2
    (tmp_path / "bad.mind").write_text("reads x\n")
    assert mindc("diff", tmp_path / "bad.mind", drive).code == 1
