"""`mindc run` and `mindc bench` on a mind that has nothing to learn."""

import json
import math
import subprocess
import sys
from pathlib import Path
from statistics import mean, stdev
from types import SimpleNamespace

import pytest

from mindlang.cli import _session
from mindlang.run.setup import layouts
from tests.calling import RULES, Call

RUN_KEYS = {"score", "by_line", "counts", "ticks", "ended_by", "seed", "task", "master"}
BENCH_KEYS = {"runs", "count_mean", "count_std", "runtime_mean", "ended", "ticks", "seconds"}
HALL = "task Chase in arena size 40\n  contains mat is zone size 12 reached moves"
TWO = RULES.replace("task Chase in plain", HALL).replace("  counts reach", "  counts reach of mat\n  counts reach", 1)


def test_run_as_json_says_everything_and_adds_up(mindc: Call, rules: Path) -> None:
    said = mindc("run", rules, "--task", "Chase", "--seed", 3, "--json")
    found = json.loads(said.out)
    assert said.code == 0
    assert set(found) >= RUN_KEYS
    assert list(found["by_line"]) == [
        "rewards 10 on reach of ball",
        "rewards 0.001 * progress toward ball per tick",
    ]
    assert math.isclose(sum(found["by_line"].values()), found["score"], rel_tol=1e-12)
    assert (found["task"], found["master"], found["seed"], found["ticks"]) == ("Chase", "Roam", 3, 1200)
    assert found["by_line"]["rewards 10 on reach of ball"] == 10 * found["counts"] > 0


def test_the_same_seed_gives_the_same_run_and_a_drawn_one_is_printed(mindc: Call, rules: Path) -> None:
    first = json.loads(mindc("run", rules, "--json").out)
    assert json.loads(mindc("run", rules, "--seed", first["seed"], "--json").out) == first


def test_without_a_task_it_is_the_first_unless_the_master_is_taught(mindc: Call, rules: Path) -> None:
    assert json.loads(mindc("run", rules, "--json").out)["task"] == "Chase"


def test_another_master_and_no_interruption(mindc: Call, rules: Path) -> None:
    options = ("run", rules, "--task", "Roam", "--seed", 3, "--master", "Chase", "--json")
    found = json.loads(mindc(*options).out)
    assert (found["master"], found["ended_by"]) == ("Chase", "collision")
    assert found["ticks"] < 600
    longer = json.loads(mindc(*options, "--no-interruption").out)
    assert (longer["ended_by"], longer["ticks"]) == (None, 600)


def test_the_summary_is_for_people(mindc: Call, rules: Path) -> None:
    said = mindc("run", rules, "--seed", 3)
    assert "Chase with Roam in charge" in said.out
    assert "rewards 10 on reach of ball" in said.out
    assert "1,200 of 1,200, lasted its time" in said.out
    assert "runs from" not in said.out


def test_bench_is_run_many_times(mindc: Call, rules: Path) -> None:
    found = json.loads(mindc("bench", rules, "--task", "Roam", "--runs", 6, "--seed", 5, "--json").out)
    assert set(found) >= BENCH_KEYS
    runs = [json.loads(mindc("run", rules, "--task", "Roam", "--seed", s, "--json").out) for s in layouts(5, 6)]
    assert found["count_mean"] == sum(run["counts"] for run in runs) / 6
    assert found["ticks"] == sum(run["ticks"] for run in runs)
    assert math.isclose(found["score_mean"], sum(run["score"] for run in runs) / 6)
    assert math.isclose(found["runtime_mean"], found["ticks"] / 6 / 600)
    ended = [run["ended_by"] or "time" for run in runs]
    assert found["ended"] == {name: ended.count(name) for name in set(ended)}
    assert found["best_seed"] == max(runs, key=lambda run: run["score"])["seed"]
    assert layouts(5, 6)[found["best_run"] - 1] == found["best_seed"]


def test_a_single_run_of_many_is_named_briefly(mindc: Call, rules: Path) -> None:
    text = mindc("bench", rules, "--task", "Roam", "--runs", 6, "--seed", 5).out
    said = text.partition("mindc run --seed ")[2].split()[0]
    best = json.loads(mindc("run", rules, "--task", "Roam", "--seed", said, "--json").out)
    found = json.loads(mindc("bench", rules, "--task", "Roam", "--runs", 6, "--seed", 5, "--json").out)
    assert best["seed"] == found["best_seed"]
    for wrong in ("5/", "/3", "5/0", "x/1", "5/1/2", "5/99999999999"):
        assert mindc("run", rules, "--task", "Roam", "--seed", wrong).code == 2


def test_every_counted_event_has_its_own_number(mindc: Call, rules: Path) -> None:
    rules.write_text(TWO)
    runs = [json.loads(mindc("run", rules, "--seed", seed, "--json").out) for seed in layouts(5, 6)]
    found = json.loads(mindc("bench", rules, "--runs", 6, "--seed", 5, "--json").out)
    events = ["reach of mat", "reach of ball"]
    assert found["counted"] == list(found["by_event"]) == list(runs[0]["by_event"]) == events
    for event in events:
        each = [run["by_event"][event] for run in runs]
        assert sum(each) > 0
        assert found["by_event"][event]["mean"] == pytest.approx(mean(each))
        assert found["by_event"][event]["std"] == pytest.approx(stdev(each))
        assert found["by_event"][event]["standard_error"] == pytest.approx(stdev(each) / 6**0.5)
    assert all(run["counts"] == sum(run["by_event"].values()) for run in runs)
    assert found["score_standard_error"] == pytest.approx(stdev(run["score"] for run in runs) / 6**0.5)
    said = [line.split() for line in mindc("run", rules, "--seed", layouts(5, 1)[0]).out.splitlines()]
    first, second = (str(runs[0]["by_event"][event]) for event in events)
    assert said[2:4] == [["counted", first, "×", *events[0].split()], [second, "×", *events[1].split()]]


def test_from_one_run_nobody_knows_how_far_it_is_off(mindc: Call, rules: Path) -> None:
    found = json.loads(mindc("bench", rules, "--runs", 1, "--json").out)
    assert [value for name, value in found.items() if name.endswith(("_std", "_error"))] == [None] * 4
    assert "±" not in mindc("bench", rules, "--runs", 1).out
    assert "; ± is the standard error of the mean" in mindc("bench", rules, "--runs", 2).out


def test_workers_change_nothing(mindc: Call, rules: Path) -> None:
    one, two = (
        json.loads(mindc("bench", rules, "--runs", 9, "--workers", workers, "--json").out) for workers in (1, 2)
    )
    for key in ("seconds", "ticks_per_second", "cpu_seconds", "ticks_per_cpu_second", "workers"):
        del one[key], two[key]
    assert one == two


def test_a_first_run_says_why_it_takes_so_long(mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_session, "cache", SimpleNamespace(missing=lambda units: [*units]))
    assert mindc("run", rules, "--seed", 3).err == f"{_session.COMPILING}\n"
    assert mindc("run", rules, "--seed", 3, "--quiet").err == ""


def test_bench_for_people(mindc: Call, rules: Path) -> None:
    said = mindc("bench", rules, "--runs", 4)
    assert said.code == 0
    assert "4 from seed 1" in said.out
    assert "lasted its time: 100%" in said.out


@pytest.mark.parametrize(
    ("options", "message", "hint"),
    [
        (["--task", "Chas"], "there is no task called Chas", "Did you mean Chase?"),
        (["--master", "Roma"], "there is no skill called Roma", "Did you mean Roam?"),
    ],
)
@pytest.mark.parametrize("command", ["run", "bench"])
def test_unknown_names_are_wrong_usage(
    mindc: Call, rules: Path, command: str, options: list[str], message: str, hint: str
) -> None:
    assert mindc(command, rules, *options) == (2, "", f"{message}\n  {hint}\n")


def test_the_speed_of_no_video_is_refused(mindc: Call, rules: Path) -> None:
    said = mindc("run", rules, "--speed", 4)
    assert (said.code, said.out) == (2, "")
    assert "--speed is of --video: say it, too." in said.err


def test_a_mind_without_a_task_says_so(mindc: Call, rules: Path) -> None:
    rules.write_text(RULES[: RULES.index("task ")].replace("sensor ball_bearing is bearing of ball\n", "").replace(
        "  reads ball_bearing\n  drives left_wheel at 3 * ball_bearing - 0.7\n"
        "  drives right_wheel at 2.3 - 3 * ball_bearing\n", "  drives left_wheel at 1\n"))  # fmt: skip
    assert mindc("run", rules) == (1, "", "there is no task to run\n  add one: task Go in plain\n")


def test_a_score_that_is_not_a_number_is_null_and_a_fault(mindc: Call, rules: Path) -> None:
    broken = RULES.replace("rewards 10 on reach", "rewards 1 / (feeler - feeler) on reach", 1)
    rules.write_text(broken.replace("at 0 30 330 deg", "at 0 deg"))
    found = json.loads(mindc("run", rules, "--task", "Chase", "--seed", 3, "--json").out)
    assert found["score"] is None
    assert found["faults"] > 0
    assert "not a number" in mindc("run", rules, "--task", "Chase", "--seed", 3).out
    assert json.loads(mindc("bench", rules, "--task", "Chase", "--runs", 3, "--json").out)["score_mean"] is None


INTERRUPTED = """
import os, signal, threading
from mindlang.cli import main
from mindrun.sim.rollout import Rollout

score = Rollout.score

def begun(*words, **more):
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    return score(*words, **more)

Rollout.score = begun
main()
"""


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_ends_a_long_bench_at_once(rules: Path, workers: int) -> None:
    rules.write_text(RULES.replace("lasts 600 ticks", "lasts 1000000 ticks"))
    words = ["bench", rules, "--task", "Roam", "--runs", "512", "--no-interruption", "--workers", f"{workers}"]
    done = subprocess.run([sys.executable, "-c", INTERRUPTED, *words], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, "Traceback" in done.stderr) == (130, "", False)
