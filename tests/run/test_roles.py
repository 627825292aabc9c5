"""Who does what in a team is what influence says, tick by tick; how labour is divided by that, held against sums."""

import json
from math import log
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from mindrun.graph.policy import Policy
from mindrun.numbers.arrays import Integers
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import joined, trace

import mindlang
from mindlang.run.roles import CHANCE_PIECES, by_chance, compared_skills, division_of_labour, roles_of, times_of
from tests.calling import Call
from tests.sim.minds import compile_text

GUARDS = """\
tick 1/20 s
master Guard
body Rover is disc size 2
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor to_west is bearing of west_gate
sensor to_east is bearing of east_gate
sensor from_west is distance of west_gate range 80
sensor from_east is distance of east_gate range 80
skill GuardWest is rule
  reads to_west
  drives left_wheel at 0.2 + to_west
  drives right_wheel at 1.2 - to_west
skill GuardEast is rule
  reads to_east
  drives left_wheel at 0.2 + to_east
  drives right_wheel at 1.2 - to_east
skill Turn is rule
  drives left_wheel at 0.6
skill Guard is rule
  reads from_west
  reads from_east
  influences Turn at 1
  influences GuardWest at 1 - from_west when from_west < 25%
  influences GuardEast at 1 - from_east when from_east < 25%
task Guard in arena size 60
  contains mate is robot count 3
  contains west_gate is zone size 6 at -20 0
  contains east_gate is zone size 6 at 20 0
  lasts 30 s
  ends on collision with mate
  counts reach of west_gate
"""
APART = GUARDS.replace("robot count 3", "robot at 15 0").replace("  lasts", "  starts at -15 0\n  lasts")
TABLES = arrays(np.int64, array_shapes(min_dims=2, max_dims=2, max_side=6), elements=st.integers(0, 50))


def summed(times: Integers) -> float:
    """I / H of a table of times, cell by cell."""
    total, shared, entropy = times.sum(), 0.0, 0.0
    for skill in range(times.shape[1]):
        its = times[:, skill].sum() / total
        entropy -= its * log(its) if its else 0.0
        for robot in range(times.shape[0]):
            both = times[robot, skill] / total
            shared += both * log(both / its / (times[robot].sum() / total)) if both else 0.0
    return shared / entropy


@given(TABLES, st.randoms())
def test_the_division_of_labour_is_a_sum_over_cells(times: Integers, random: Random) -> None:
    found = division_of_labour(times)
    if np.count_nonzero(times.sum(axis=0)) < 2:
        assert found is None
        return
    assert found == pytest.approx(summed(times), abs=1e-12)
    robots, skills = (random.sample(range(side), side) for side in times.shape)
    assert found == pytest.approx(division_of_labour(3 * times[robots][:, skills]), abs=1e-12)


@given(st.lists(st.integers(0, 4), min_size=2, max_size=9), st.integers(1, 9))
def test_specialists_divide_all_and_robots_alike_nothing(roles: list[int], ticks: int) -> None:
    assume(len({*roles}) > 1)
    specialists = times_of(np.array([roles] * ticks, np.int16), 5)
    assert division_of_labour(specialists) == pytest.approx(1, abs=1e-12)
    assert division_of_labour(specialists.sum(axis=0) * np.ones((3, 1), np.int64)) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("robots", [2, 5])
def test_robots_that_are_alike_and_keep_a_role_for_a_while_divide_as_much_as_by_chance(robots: int) -> None:
    random = np.random.default_rng(1)
    runs = [random.integers(-1, 3, (CHANCE_PIECES, robots), np.int16).repeat(7, axis=0) for _ in range(300)]
    divided = [(division_of_labour(times_of(roles, 3)) or 0.0) - by_chance(roles, 3, random) for roles in runs]
    assert abs(np.mean(divided)) < 4 * np.std(divided) / len(runs) ** 0.5
    specialists = (np.arange(robots) % 2 * np.ones((1000, 1))).astype(np.int16)
    assert by_chance(specialists, 3, random) < 0.2


def test_the_skills_that_a_master_shares_influence_out_to_are_compared() -> None:
    above = "skill Above is rule\n  reads from_west\n  influences Guard at from_west\n"
    graph = compile_text(GUARDS.replace("master Guard", "master Above") + above)
    names = {
        master: [graph.skills[i].name for i in compared_skills(graph, graph.skill_numbers[master])]
        for master in ("Guard", "Above", "Turn")
    }
    assert names == {"Guard": ["GuardWest", "GuardEast"], "Above": ["GuardWest", "GuardEast"], "Turn": ["Turn"]}


def test_a_role_is_the_skill_of_most_influence_in_every_tick_whatever_lanes_there_are() -> None:
    graph = compile_text(GUARDS)
    rollout = Rollout(Policy(graph, {}), "Guard", "Guard", lanes=12)
    skills, seeds = compared_skills(graph, graph.skill_numbers["Guard"]), range(1, 9)
    together = roles_of(rollout, skills, seeds)
    ticks = [len(roles) for roles in together]
    assert len({*ticks}) > 3
    assert ticks == rollout.score(np.zeros((1, 0), np.float32), seeds).ticks[0].tolist()
    for seed, roles in zip(seeds, together, strict=True):
        influence = joined(trace(rollout, seed).chunks).influence[:, skills]
        assert np.array_equal(roles[:, 0], np.where(influence.max(axis=1) > 0, influence.argmax(axis=1), -1))
        assert np.array_equal(roles, roles_of(rollout, skills, [seed])[0])
    assert {*np.concatenate(together).ravel().tolist()} == {-1, 0, 1}


@pytest.fixture
def team(tmp_path: Path) -> Path:
    path = tmp_path / "team.mind"
    path.write_text(APART, encoding="utf-8")
    return path


def test_robots_at_two_gates_have_a_role_each(mindc: Call, team: Path) -> None:
    found = json.loads(mindc("bench", team, "--runs", 3, "--json").out)
    assert found["roles"]["robots"] == [0, 1]
    assert found["roles"]["skills"] == ["GuardWest", "GuardEast"]
    assert [run["shares"] for run in found["roles"]["runs"]] == [[[1, 0], [0, 1]]] * 3
    assert found["roles"]["division_of_labour"] == {"mean": 1, "std": 0, "standard_error": 0}
    assert mindlang.load(team).bench(runs=3)["roles"] == found["roles"]
    said = mindc("bench", team, "--runs", 3).out.splitlines()
    assert said[-5:-2] == [
        "roles in run 2  GuardWest  GuardEast",
        "robot 0              100%         0%",
        "robot 1                0%       100%",
    ]
    assert said[-2].startswith("division of labour 1.000 ± 0.000, by chance 0.")
    assert said[-1] == "of 3 runs; above, that of median division"
    reached = found["by_event"]["reach of west_gate"]["mean"]
    assert f"reach of west_gate ({reached / 2:.2f} per robot)" in "\n".join(said)


def test_where_there_is_nothing_to_choose_no_labour_is_divided(mindc: Call, team: Path) -> None:
    last = mindc("bench", team, "--runs", 2, "--task", "Guard", "--master", "Turn").out.splitlines()[-1]
    assert last == "no division of labour: Turn alone is the role of all robots"
    west = team.read_text(encoding="utf-8").replace("at 15 0", "at -15 8")
    team.write_text(west, encoding="utf-8")
    last = mindc("bench", team, "--runs", 2).out.splitlines()[-1]
    assert last == "no division of labour: GuardWest alone is the role of all robots"
    team.write_text("".join(line for line in west.splitlines(True) if "mate" not in line), encoding="utf-8")
    found = json.loads(mindc("bench", team, "--runs", 2, "--json").out)
    assert "roles" not in found


def test_what_any_of_several_masters_shares_out_is_compared(mindc: Call, team: Path) -> None:
    text = (
        team.read_text(encoding="utf-8")
        .replace("at 15 0", "at 15 0 under Turn")
        .replace("influences Turn", "reads to_west #")
    )
    team.write_text(text, encoding="utf-8")
    roles = json.loads(mindc("bench", team, "--runs", 2, "--json").out)["roles"]
    assert roles["skills"] == ["GuardWest", "GuardEast", "Turn"]
    for (west, *others), turning in (run["shares"] for run in roles["runs"]):
        assert (west > 0.9, others, turning) == (True, [0, 0], [0, 0, 1])


def test_robots_that_are_not_paid_are_none_of_the_team(mindc: Call, team: Path) -> None:
    text = team.read_text(encoding="utf-8")
    text = text.replace("at 15 0", "at 15 10 paid 0 under Turn\n  contains other is robot at 15 -10")
    team.write_text(text, encoding="utf-8")
    roles = json.loads(mindc("bench", team, "--runs", 2, "--json").out)["roles"]
    assert (roles["robots"], roles["skills"]) == ([0, 2], ["GuardWest", "GuardEast"])
    assert [run["shares"] for run in roles["runs"]] == [[[1, 0], [0, 1]]] * 2
    assert "robot 2" in mindc("bench", team, "--runs", 2).out
