"""Which sensors somebody measures: those that are read or paid for, and what they are computed of, sources first."""

import pytest
from mindrun.graph.graph import Sensor
from mindrun.graph.measured import measured_in_world, measured_on_robot, rows_of, used_sensors, with_sources
from mindrun.graph.skill_sets import reachable

from tests.sim.minds import compile_text

GRAPH = compile_text("""\
tick 1/50 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
sensor mean is computed at (calm + ear) / 2
sensor calm is average of eye over 3 ticks
sensor eye is range_finder at 0 deg
sensor ear is range_finder at 90 deg
sensor nose is range_finder at 180 deg
sensor wide is range_finder at 30 60 90 deg
sensor hip is compass
sensor charge is battery
memory mood is cell decay 0.9
skill Go is rule
  reads mean
  reads mood
  drives left_wheel at mean
skill Other is rule
  reads hip
  drives left_wheel at hip
  drives mood at hip
task Course in arena size 60
  lasts 40 ticks
  rewards calm per tick
  rewards 0.1 * p per tick for each p in wide
  ends when nose > 0.5
""")
[TASK] = GRAPH.tasks


def names(of: list[Sensor]) -> list[str]:
    return [each.name for each in of]


def test_what_skills_depend_on_and_what_is_paid_for_beside_it() -> None:
    used, aside = used_sensors(GRAPH, reachable(GRAPH, "Go"), TASK)
    assert names(used) == ["eye", "calm", "ear", "mean"]
    assert names(aside) == ["nose", "wide"]
    assert names(measured_in_world(GRAPH, "Go", TASK)) == [*names(used), "nose", "wide"]
    assert names(measured_in_world(GRAPH, "Other", TASK)) == ["hip", "eye", "calm", "nose", "wide"]


@pytest.mark.parametrize(
    ("wired", "measured"),
    [
        (("eye", "ear"), ["mean", "calm", "eye", "ear"]),
        (("eye", "nose"), ["calm", "eye", "nose"]),
        (("ear", "hip"), ["ear", "hip"]),
        ((), []),
    ],
)
def test_on_a_robot_what_is_wired_and_what_is_computed_of_that_alone(wired: list[str], measured: list[str]) -> None:
    assert names(measured_on_robot(GRAPH, wired)) == measured


def test_the_readings_of_sensors_are_known_and_those_of_memories() -> None:
    starts = {each.name: each.start for each in GRAPH.sensors} | {each.name: each.start for each in GRAPH.memories}
    wide, mood = starts["wide"], starts["mood"]
    known = rows_of(GRAPH, [each for each in GRAPH.sensors if each.name == "wide"])
    assert known.nonzero()[0].tolist() == [wide, wide + 1, wide + 2, mood]
    assert len(known) == GRAPH.width
    for row in range(wide, wide + 3):
        assert names(with_sources(GRAPH, {row})) == ["wide"]
    assert names(with_sources(GRAPH, {wide - 1, wide + 3})) == ["nose", "hip"]
