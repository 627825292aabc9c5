"""`mindc status --accept`: a person says that weights will do in another world."""

import json
from pathlib import Path

from tests.calling import Call
from tests.edits.taught import recorded, teach


def test_what_a_person_accepts_is_not_taught_again(mindc: Call, drive: Path) -> None:
    teach(drive)
    drive.write_text(drive.read_text().replace("thrust 80", "thrust 70"))
    old = recorded(drive)
    rows = json.loads(mindc("status", drive, "--json").out)["skills"]
    assert {row["skill"]: row["status"] for row in rows} == {"Drive": "taught elsewhere", "Go": "taught elsewhere"}
    said = mindc("status", drive, "--accept", "Go", "Drive")
    assert said.code == 0, said.err
    assert "accepted by a person" in said.out
    assert "nothing to do" in mindc("train", drive).err
    assert recorded(drive) == old
    drive.write_text(drive.read_text().replace("thrust 70", "thrust 60"))
    assert "taught with left_wheel thrust 70, now 60" in mindc("status", drive).out


def test_what_cannot_be_accepted(mindc: Call, drive: Path) -> None:
    said = mindc("status", drive, "--accept", "Goo")
    assert (said.code, said.err.splitlines()) == (2, ["There is no skill Goo.", "  Did you mean Go?"])
    said = mindc("status", drive, "--accept", "Go")
    assert (said.code, said.err.splitlines()) == (1, ["Go has no weights that fit, and none can be accepted."])
    said = mindc("status", drive, "--accept")
    assert said.code == 2
    assert said.err.startswith("--accept needs the skills whose weights will do.")


def test_status_shows_the_skills_that_are_named(mindc: Call, drive: Path) -> None:
    rows = json.loads(mindc("status", drive, "Go", "--json").out)["skills"]
    assert [row["skill"] for row in rows] == ["Go"]
    assert mindc("status", drive, "Gone").code == 2


def test_of_a_lesson_that_is_said_again_the_one_that_was_taught_last_is_accepted(mindc: Call, drive: Path) -> None:
    again = "  teaches Drive on Reach for 2 generations using evolution_strategy\ncurriculum Rest"
    drive.write_text(drive.read_text().replace("curriculum Rest", again))
    assert mindc("train", drive, "--curriculum", "School", "--seed", "2").code == 0
    drive.write_text(drive.read_text().replace("thrust 80", "thrust 70"))
    assert mindc("status", drive, "--accept", "Go", "Drive").code == 0
    rows = json.loads(mindc("status", drive, "--json").out)["skills"]
    assert {row["skill"]: row["status"] for row in rows} == {"Drive": "trained", "Go": "trained"}
    assert "nothing to do" in mindc("train", drive, "--curriculum", "School").err


def test_a_lesson_of_another_curriculum_is_due_where_a_subskill_was_taught_since(mindc: Call, drive: Path) -> None:
    again = "curriculum Again is genetic population 8\n  teaches Drive on Reach for 1 generations\n"
    drive.write_text(drive.read_text() + again)
    assert mindc("train", drive, "--curriculum", "School", "--seed", "2").code == 0
    assert "nothing to do" in mindc("train", drive, "--curriculum", "Again").err
    assert mindc("train", drive, "Go", "--curriculum", "School", "--force", "--from-scratch", "--seed", "5").code == 0
    assert "Drive on Reach from its weights" in mindc("train", drive, "--curriculum", "Again", "--seed", "1").err
