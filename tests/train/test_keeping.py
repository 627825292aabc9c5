"""What a lesson has taught goes to the lock, unless it is nothing, or what is there does better."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from mindlang.lock import lock_path, read_lock
from mindlang.lock.blobs import blob, digest
from tests.calling import Call
from tests.edits.taught import recorded, teach
from tests.train.test_train_command import MIND

QUICK = ("--seed", "2", "--generations", "1")


def test_worse_weights_take_no_place_without_force(mindc: Call, drive: Path) -> None:
    assert mindc("train", drive, "Go", "--seed", 3, "--generations", 30).code == 0
    good = recorded(drive)
    said = mindc("train", drive, "Go", "--from-scratch", "--json", *QUICK)
    assert (said.code, recorded(drive)) == (0, good)
    result = json.loads(said.out)
    learnt = np.load(drive.parent / result["run"] / "weights.npy")
    assert (result["kept"], result["weights"]) == (False, {"Go": digest(learnt)})
    assert recorded(drive) == good
    assert result["compared"][0] > result["compared"][1]
    assert "the weights that were there do better" in said.err
    assert "--force puts them there" in said.err
    assert (drive.parent / result["run"] / "weights.npy").exists(), "what was learnt is not lost"
    forced = mindc("train", drive, "Go", "--from-scratch", "--force", *QUICK)
    assert forced.code == 0, forced.err
    assert recorded(drive) != good
    assert "but the weights that were there do better" in forced.err
    assert blob(drive.parent, good).exists(), "mindc gc alone removes weights"


def test_better_weights_take_the_place(mindc: Call, drive: Path) -> None:
    teach(drive, "Go")
    old = recorded(drive)
    said = mindc("train", drive, "Go", "--seed", 3, "--generations", 30, "--from-scratch", "--json")
    assert said.code == 0, said.err
    result = json.loads(said.out)
    assert result["compared"][0] < result["compared"][1]
    assert (result["kept"], result["weights"]["Go"]) == (True, recorded(drive))
    assert recorded(drive) != old


def test_a_lesson_that_tells_nobody_apart_has_taught_nothing(mindc: Call, drive: Path) -> None:
    text = MIND.replace(
        "  rewards 10 on reach of object\n  rewards progress toward object per tick\n", "  rewards 0.1 per tick\n"
    )
    drive.write_text(text)
    said = mindc("train", drive, "Go", *QUICK)
    assert said.code == 1
    assert said.err.splitlines()[-2].startswith(
        "Go has learnt nothing: every genome of a generation scored the same, 10.00"
    )
    assert not lock_path(drive).exists()
    again = mindc("train", drive, "Go", *QUICK)
    assert again.code == 1, "the run is done, and is not taught once more"
    assert len([*(drive.parent / "runs").glob("Go-on-Reach/*")]) == 1


def test_all_faults_have_taught_nothing(mindc: Call, drive: Path) -> None:
    said = mindc("train", drive, "--curriculum", "Rest", *QUICK)
    assert said.code == 1
    assert "on 100 of 100 fresh layouts a reward or a command of the best genome was no finite number" in said.err


def test_faults_on_some_layouts_are_counted(mindc: Call, drive: Path) -> None:
    """A bearing is 0.5 where its thing is beyond its range, which of 10 to 40 units are those beyond 25."""
    text = MIND.replace("task Reach", "sensor near is bearing of object range 25\ntask Reach")
    drive.write_text(text.replace("1 / (forward - forward) per tick", "1 / (near - 0.5) per tick"))
    said = mindc("train", drive, "--curriculum", "Rest", *QUICK)
    assert said.code == 1
    found = re.search(r"on (\d+) of 100 fresh layouts a reward or a command of the best genome", said.err)
    assert found
    assert 20 < int(found[1]) < 80


def test_a_lesson_that_fails_keeps_nothing_and_nothing_is_taught_on_top_of_it(mindc: Call, drive: Path) -> None:
    """It ends with the first attempt that does what is needed; a shortened one is held to nothing, and says so."""
    text = drive.read_text().replace("Go on Reach for 3 generations", "Go on Reach for 3 generations NEEDS attempts 4")
    drive.write_text(text.replace("NEEDS", "needs score > 1000"))
    said = mindc("train", drive, "--seed", 1, "--force")
    assert said.code == 1
    failed = "Go has failed its lesson, which needs {} on two sets of fresh layouts: the best of 4 attempts scored"
    assert failed.format("score > 1000") in said.err
    assert not lock_path(drive).exists()
    assert [each.name for each in (drive.parent / "runs").iterdir()] == ["Go-on-Reach"]
    can_succeed = text.replace("  rewards 10 on reach of object\n", "  succeeds on 99 reach of object\n", 1)
    drive.write_text(can_succeed.replace("NEEDS", "needs success > 50%"))
    said = mindc("train", drive, "--seed", 1, "--force")
    assert failed.format("success > 50%") in said.err
    assert ", and succeeded in 0% and 0% of the runs; the lock stays as it is" in said.err
    drawn = mindc("plot", drive.parent / "runs", "--json", "-o", drive.parent / "runs.svg")
    assert ["has failed its lesson" in curve["failed"] for curve in json.loads(drawn.out)["curves"]] == [True, True]
    assert (drive.parent / "runs.svg").read_text().count("<!-- Go-on-Reach, failed -->") == 2
    drive.write_text(text.replace("NEEDS", "needs score > -1000"))
    taught = mindc("train", drive, "--seed", 1, "--json")
    assert taught.code == 0, taught.err
    assert [json.loads(line)["attempts"] for line in taught.out.splitlines()] == [1, 1]
    drive.write_text(text.replace("NEEDS", "needs score > 1000"))
    shortened = mindc("train", drive, "Go", "--seed", 1, "--generations", 2)
    assert shortened.code == 0, shortened.err
    assert "Go has fewer generations than its lesson says: nothing is needed of it" in shortened.err


def test_what_a_lesson_needs_is_asked_of_what_is_there(mindc: Call, drive: Path) -> None:
    """By what it scored when it was taught: after an edit, and for what would be taught on top of it by name."""
    assert mindc("train", drive, *QUICK).code == 0
    needing = drive.read_text().replace(
        "Go on Reach for 3 generations", "Go on Reach for 3 generations needs score > 9999"
    )
    drive.write_text(needing)
    assert "lesson 1 of" in mindc("status", drive).out
    refused = mindc("train", drive, "Drive", *QUICK)
    assert refused.code == 1
    assert "Drive would be taught on top of Go, without what its lesson needs: score > 9999" in refused.err
    assert mindc("train", drive, "Drive", "--force", *QUICK).code == 0
    drive.write_text(needing.replace("> 9999", "> -9999"))
    assert "lesson 1 of" not in mindc("status", drive).out


def test_how_often_it_succeeded_is_known_where_its_lesson_needs_that(mindc: Call, drive: Path) -> None:
    text = drive.read_text().replace("Go on Reach for 3 generations", "Go on Reach for 3 generations NEEDS")
    text = text.replace("lasts 100 ticks", "lasts 100 ticks\n  succeeds when forward > 0.01", 1)
    drive.write_text(text.replace("NEEDS", ""))
    assert mindc("train", drive, *QUICK).code == 0
    assert read_lock(lock_path(drive))["Go"].taught.success is None
    drive.write_text(text.replace("NEEDS", "needs success > 10%"))
    assert "lesson 1 of" in mindc("status", drive).out  # it is not known to succeed
    assert mindc("train", drive, *QUICK).code == 0
    taught = read_lock(lock_path(drive))["Go"].taught
    tried = json.loads(mindc("bench", drive, "--task", "Reach", "--master", "Go", "--runs", 400, "--json").out)
    assert taught.success == pytest.approx(tried["success"]["mean"], abs=0.25)
    assert "nothing to do" in mindc("train", drive, *QUICK).err
    lock_path(drive).write_text(lock_path(drive).read_text().replace(f" success {taught.success}", " success 0.1"))
    assert "lesson 1 of" in mindc("status", drive).out


def test_train_is_like_make(mindc: Call, drive: Path) -> None:
    """What has changed since is taught again, and then there is nothing to do; options of once are no change."""
    small = ("--population", "4", "--attempts", "1", *QUICK)
    assert mindc("train", drive, *small).code == 0
    assert "nothing to do" in mindc("train", drive, *small).err
    drive.write_text(drive.read_text().replace("rewards 10 on", "rewards 5 on"))
    assert "taught elsewhere" in mindc("status", drive).out
    said = mindc("run", drive, "--task", "Reach", "--master", "Go", "--seed", 1, "--json")
    assert said.code == 0
    note = "Go was taught elsewhere: its task has changed: rewards 10 on reach of object, now 5"
    assert note in json.loads(said.out)["notes"][0] or note in said.err
    taught = mindc("train", drive, "--json", *small)
    assert [json.loads(line)["skill"] for line in taught.out.splitlines()] == ["Go", "Drive"]
    assert "nothing to do" in mindc("train", drive, *small).err
    assert "taught elsewhere" not in mindc("status", drive).out
