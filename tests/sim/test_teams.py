"""Several robots in one world: their contacts are Chipmunk's, and who is which of them changes nothing but names."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pymunk
import pytest
from mindrun.graph.policy import Policy
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.numbering import rows_by_name
from mindrun.sim.rollout import Rollout, Tile

from mindlang.physics_check import ROBOT_FRICTION, add, arena, disc, drive
from tests.draws import first
from tests.sim.minds import DRIFTER, compile_text

ROCKS, SCATTERED = "grid 10 size 2 to 4 jitter 1", "grid 7 size 2 to 3 jitter 1"
TICKS = 5_000
TOGETHER = (  # drawn to each other with one wheel, to objects with the other
    DRIFTER.replace("(object_bearing - 0.5) * quick", "(mate_bearing - 0.5) * quick")
    .replace("skill Drift", "sensor mate_bearing is bearing of mate\nskill Drift")
    .replace("  reads odd", "  reads mate_bearing\n  reads odd")
)


def drifters(mates: int, rocks: str, items: int, more: str = "") -> Rollout:
    """Robots that drift about in an arena, close their claws now and then, and push each other."""
    task = f"""task Drift in arena size 40
  contains mate is robot count {mates}
  contains object is item size 1 count {items}
  contains rock is obstacle {rocks}
  lasts {TICKS} ticks
  rewards 1 on collision
  rewards 1 on collision with mate
{more}"""
    return Rollout(Policy(compile_text(TOGETHER + task), {}), "Drift", "Drift", interrupt=False)


def ticks(rollout: Rollout, seed: int) -> Iterator[Tile]:
    """The tile of a run as it begins, and after each tick: a lane for each robot."""
    tile, jobs = rollout.tile(1), rollout.jobs(np.zeros((1, 0), np.float32), np.array([seed], np.uint64))
    rollout.fill(tile, jobs)
    yield tile
    for _ in range(TICKS - 1):
        rollout.advance(tile, jobs, 1)
        yield tile


class PlainTeam:
    """The paper's robots in one Space, with what each claw may hold."""

    def __init__(self, poses: np.ndarray, boxes: np.ndarray, half: float, items: range) -> None:
        self.space = arena(boxes, half)
        self.bodies = [disc(self.space, pose) for pose in poses]
        self.items = [{item: pymunk.Circle(body, 0.5, (1.5, 0)) for item in items} for body in self.bodies]
        for item in (item for its in self.items for item in its.values()):
            add(self.space, item, ROBOT_FRICTION)

    def step(self, commands: np.ndarray, angles: np.ndarray, held: np.ndarray) -> np.ndarray:
        """The poses and velocities [robots, 6] after a tick."""
        for body, items, (left, right), angle, thing in zip(
            self.bodies, self.items, commands, angles, held, strict=True
        ):
            for number, item in items.items():
                item.sensor = number != thing
            drive(body, float(left), float(right), cosine(angle), sine(angle))
        self.space.step(1 / 60)
        return np.array([(*each.position, each.angle, *each.velocity, each.angular_velocity) for each in self.bodies])


@pytest.mark.parametrize("rocks", [ROCKS, SCATTERED])
@pytest.mark.parametrize("mates", [1, 3, 7])
@pytest.mark.parametrize("seed", first(2, range(12)))
def test_robots_that_push_each_other_equal_plain_pymunk(mates: int, rocks: str, seed: int) -> None:
    rollout = drifters(mates, rocks, 4)
    run, robots = ticks(rollout, seed), 1 + mates
    world = (tile := next(run)).state.world
    before = world.body[:, :robots].T.copy()
    boxes = world.boxes[0].reshape(-1, 4)
    plain, met, carried = PlainTeam(before[:, :3], boxes, 20.0, rows_by_name(rollout.task)["object"]), 0, 0
    for number, tile in enumerate(run):
        found = plain.step(world.acting[:2, :robots].T, before[:, 2], world.held[:robots])
        before = world.body[:, :robots].T.copy()
        assert np.array_equal(found, before), f"tick {number}"
        met += int((tile.state.contact.mates[0, :robots] != 0).sum())
        carried += int((world.held[1:robots] >= 0).sum())
    assert met or mates < 7
    assert carried or mates < 7


@pytest.mark.parametrize("seed", first(3, range(12)))
def test_who_is_which_robot_changes_nothing_but_names(seed: int) -> None:
    """Until one robot touches several solids at once, of which Chipmunk solves one before the other, by their order."""
    order, rollout = np.array([2, 0, 3, 1]), drifters(3, ROCKS, 4)
    runs = [ticks(rollout, seed), ticks(rollout, seed)]
    one, other = (next(run).state for run in runs)
    for of_robot in (other.world.body, other.world.heading, other.world.trail):
        of_robot[:, :4] = of_robot[:, order]
    other.sight.anchor[:, :4] = np.nan
    for number in range(4):
        thing = rollout.tables.robots["thing"][number]
        for lane in range(4):
            place = other.world.body[:2, number] if lane != number else np.nan
            other.world.things[4 * thing : 4 * thing + 2, lane] = place
    compared = 0
    for _ in zip(*runs, strict=True):
        pairs = one.contact.pairs[0, one.contact.order[0, : one.contact.space[0]["touching"]]]
        bodies = np.concatenate([pairs["own"], pairs["other"]])
        if len(bodies) and np.bincount(bodies)[1:].max(initial=0) > 1:
            break
        compared += 1
        for name in ("body", "held", "acting"):
            theirs, its = getattr(one.world, name)[..., order], getattr(other.world, name)[..., :4]
            assert np.array_equal(theirs, its), (name, compared)
    assert compared > 50


BODY = """tick 1/20 s
master Go
body Rover is disc size 2
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper reach 1.5 neutral 0
actuator call is signal neutral 0
sensor near is contact of gem
sensor has is held of gem
sensor away is distance of gem range 100
sensor mate_away is distance of mate range 100
sensor ahead is range_finder range 20
sensor heard is signal of mate
"""


def said(skills: str, task: str, ticks: int = 40) -> tuple[Rollout, list[dict[str, float]]]:
    """The run of a world of rules, and of each robot what it has been paid for each line."""
    text = f"{BODY}{skills}task Go in plain\n{task}  lasts {ticks} ticks\n"
    rollout = Rollout(Policy(compile_text(text), {}), "Go", "Go")
    tile, jobs = rollout.tile(1), rollout.jobs(np.zeros((1, 0), np.float32), np.array([1], np.uint64))
    rollout.fill(tile, jobs)
    rollout.advance(tile, jobs, ticks)
    names = [reward.text for reward in rollout.task.rewards]
    lines = tile.state.judge.lines[: len(names)].T.tolist()
    robots = [dict(zip(names, each, strict=True)) for each in lines[: len(rollout.tables.robots)]]
    scores = rollout.score(np.zeros((1, 0), np.float32), [1])
    assert scores.by_line[0, 0].tolist() == [float(np.mean([each[name] for each in robots])) for name in names]
    return rollout, robots


def test_robots_see_and_hear_each_other_a_tick_late() -> None:
    lines = "rewards mate_away per tick", "rewards ahead per tick", "rewards heard per tick"
    task = "  starts at 0 0 facing 0 deg\n  contains mate is robot at 10 0 under Say\n  contains gem is item at 50 0\n"
    _, (first, mate) = said(
        "skill Go is rule\n  drives call at 0.25\nskill Say is rule\n  drives call at 0.75\n",
        task + "".join(f"  {line}\n" for line in lines),
    )
    away, ahead, heard = (line.removeprefix("rewards ") for line in lines)
    assert first[f"rewards {away}"] == pytest.approx(40 * 8 / 100)  # from rim to rim
    assert first[f"rewards {ahead}"] == pytest.approx(40 * 8 / 20)
    assert first[f"rewards {heard}"] == 39 * 0.75
    # The first is under another skill, so nobody else is a mate to it; it is seen, where it faces.
    assert mate == {f"rewards {away}": 40.0, f"rewards {ahead}": 40.0, f"rewards {heard}": 0.0}


TAKING = """  starts at 0 0 facing 0 deg
  contains mate is robot at 0 2.2
  contains gem is item at 1.6 {y} delivered stays
  contains home is zone size 10 at 0 0
  rewards has per tick
  rewards 1 on delivery of gem
  rewards 1 on collision with mate
"""
CLOSING = "skill Go is rule\n  drives claw at 1\n"


@pytest.mark.parametrize(("y", "taker"), [(1.0, 0), (1.1, 0), (1.2, 1)])
def test_the_nearest_claw_takes_an_item_and_nobody_else_has_it(y: float, taker: int) -> None:
    _, robots = said(CLOSING, TAKING.format(y=y))
    assert [each["rewards has per tick"] for each in robots] == [39.0 * (taker == 0), 39.0 * (taker == 1)]
    assert [each["rewards 1 on delivery of gem"] for each in robots] == [taker == 0, taker == 1]


def test_what_is_let_go_is_everybodys_and_delivered_once() -> None:
    letting_go = "skill Go is rule\n  reads heard\n  drives claw at 1 - heard\n  drives call at 1\n"
    _, robots = said(letting_go, TAKING.format(y=1.0) + "  rewards 1 per tick when away < 1/2\n")
    assert [each["rewards has per tick"] for each in robots] == [1.0, 0.0]
    assert [each["rewards 1 on delivery of gem"] for each in robots] == [1.0, 0.0]
    assert [each["rewards 1 per tick when away < 1/2"] for each in robots] == [40.0, 39.0]  # one tick in another's claw


@pytest.mark.parametrize("paid", [1, 0])
def test_an_end_for_one_robot_ends_the_run_of_all_unless_it_is_paid_nothing(paid: int) -> None:
    task = TAKING.format(y=1.2).replace("at 0 2.2", f"at 0 2.2 paid {paid}") + "  ends on delivery of gem\n"
    rollout = Rollout(
        Policy(compile_text(f"{BODY}{CLOSING}task Go in plain\n{task}  lasts 40 ticks\n"), {}), "Go", "Go"
    )
    scores = rollout.score(np.zeros((1, 0), np.float32), [1, 2])
    assert scores.ticks.tolist() == [[1, 1] if paid else [40, 40]]
    assert scores.by_event[0, 0].tolist() == ([1, 0] if paid else [0, 0])
    assert scores.by_line[0, 0].tolist() == ([0.0, 0.5, 0.0] if paid else [0.0, 0.0, 0.0])


def test_each_robot_has_procedures_that_remember_for_it_alone(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(
        "seen = []\n\n\ndef count(away):\n    seen.append(away)\n    return [len(seen) / 100]\n"
    )
    skills = "skill Go is procedure from own.count\n  reads away\n  drives call\n"
    task = "  contains mate is robot count 2\n  contains gem is item\n  rewards heard per tick\n"
    text = f"{BODY}{skills}task Go in plain\n{task}  lasts 10 ticks\n"
    rollout = Rollout(Policy(compile_text(text), {}), "Go", "Go", procedures=tmp_path)
    scores = rollout.score(np.zeros((1, 0), np.float32), [1])
    assert scores.total[0, 0] == pytest.approx(sum(range(10)) / 100)
