"""What is not there in a run is neither on the page of a view nor in a picture of it."""

from pathlib import Path

from mindlang.run.recorded_run import record_run
from tests.view.serving import prepared, simulated

MIND = """
tick 1/20 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
skill Go is rule
  drives left_wheel at 0.6
  drives right_wheel at 0.6
task World in plain
  draws side from 0 1
  contains fence is wall from -4 9 to 4 9 when side > 0.5
  contains gate is wall from -4 -9 to 4 -9
  opens gate when side > 2
  lasts 5 ticks
"""


def test_a_wall_that_is_not_there_is_not_shown(tmp_path: Path) -> None:
    path = tmp_path / "walls.mind"
    path.write_text(MIND)
    setup, sides = prepared(path, "World"), set[float]()
    for seed in range(6):
        run, world = record_run(setup, setup.rollout(True), seed), simulated(path, "World", seed).about["world"]
        is_there = run.drawn["side"] > 0
        assert [*run.standing] == [0, 1][not is_there :]
        assert world["boxes"] == [[*box] for box in run.standing.values()]
        assert world["doors"] == [int(is_there)]
        sides.add(run.drawn["side"])
    assert len(sides) == 2
