"""What a driver who knows everything delivers in Collect: python benchmarks/ceiling.py [--runs 16] [--backwards].

It sees the whole arena, takes the shortest way around the obstacles (a visibility graph, planned anew every two
seconds), drives at full speed, turns in an arc, and grips as soon as it can. Collisions end nothing. Beside it: the
same layouts under the shipped minds, and what a robot would deliver that neither turned nor swerved.
"""

import argparse
from dataclasses import dataclass, field
from math import atan2, inf, pi

import numpy as np
from mindrun.sim.rollout import Rollout
from numpy.typing import NDArray

from benchmarks.commanded import Commanded
from benchmarks.workloads import COLLECT, graph_of, shipped
from mindlang.compiler.compile import load

REPLAN_TICKS = 120  # ticks after which a way is planned anew
CLEARANCE_UNITS = 1.6  # that obstacles are wider for the robot
LOADED_CLEARANCE_UNITS = 2.2  # and for a robot that holds something
CORNER_UNITS, REACHED_UNITS = 0.02, 0.45  # beyond an inflated corner; so near a corner counts as passed
EDGE_UNITS = 48.6  # corners further out touch a wall
RUN_SECONDS = 500.0
Array = NDArray[np.float64]


def crossed(starts: Array, ends: Array, low: Array, high: Array) -> NDArray[np.bool_]:
    """Which lines from starts [n, 2] to ends [m, 2] cross any of the open boxes [boxes, 2]: [n, m]."""
    step = ends[None] - starts[:, None]
    found = np.zeros(step.shape[:2], bool)
    still = np.abs(step) < 1e-12
    for least, most in zip(low, high, strict=True):
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = (least - starts[:, None]) / step, (most - starts[:, None]) / step
        inside = (starts[:, None] > least) & (starts[:, None] < most)
        enter = np.where(still, np.where(inside, -inf, inf), np.minimum(a, b)).max(axis=2)
        leave = np.where(still, np.where(inside, inf, -inf), np.maximum(a, b)).min(axis=2)
        found |= np.maximum(enter, 0) < np.minimum(leave, 1) - 1e-9
    return found


def way(start: Array, goal: Array, boxes: Array, wider: float) -> list[Array]:
    """The corners of the shortest way around boxes [boxes, (x, y, half)], and the goal (Dijkstra's algorithm)."""
    grown = np.full(len(boxes), wider)
    for point in (start, goal):  # from within the margin of a box it must be possible to leave
        grown[(np.abs(boxes[:, :2] - point) < (boxes[:, 2] + grown)[:, None]).all(axis=1)] = 0.2
    low, high = (boxes[:, :2] + sign * (boxes[:, 2] + grown)[:, None] for sign in (-1, 1))
    sides = [
        np.stack([low[:, 0] - CORNER_UNITS, high[:, 0] + CORNER_UNITS]),
        np.stack([low[:, 1] - CORNER_UNITS, high[:, 1] + CORNER_UNITS]),
    ]
    corners = np.concatenate([np.stack([sides[0][i], sides[1][j]], axis=1) for i in (0, 1) for j in (0, 1)])
    free = ~((corners[:, None] > low) & (corners[:, None] < high)).all(axis=2).any(axis=1)
    places = np.concatenate([[start], [goal], corners[free & (np.abs(corners) < EDGE_UNITS).all(axis=1)]])
    if not crossed(places[:1], places[1:2], low, high)[0, 0]:
        return [goal]
    lengths = np.where(crossed(places, places, low, high), inf, np.linalg.norm(places[:, None] - places, axis=2))
    far, previous, left = np.full(len(places), inf), np.full(len(places), -1), np.ones(len(places), bool)
    far[0] = 0
    while left.any() and np.isfinite(far[left].min()):
        nearest = int(np.where(left, far, inf).argmin())
        left[nearest] = False
        shorter = far[nearest] + lengths[nearest] < far
        far[shorter], previous[shorter] = (far[nearest] + lengths[nearest])[shorter], nearest
    found = [1]
    while previous[found[-1]] > 0:
        found.append(int(previous[found[-1]]))
    return [places[i] for i in reversed(found)]


@dataclass(slots=True)
class Driver:
    """Who drives one robot; `legs` are the straight distances from thing to thing."""

    boxes: Array
    backwards: bool
    path: list[Array] = field(default_factory=list)
    goal: Array = field(default_factory=lambda: np.full(2, inf))
    planned: int = -REPLAN_TICKS
    legs: list[float] = field(default_factory=list)

    def drive(self, tick: int, body: Array, item: Array, zone: Array, holds: bool) -> tuple[float, float, float]:
        """Left wheel, right wheel and claw, from where all is."""
        place, goal = body[:2], zone if holds else item
        if np.abs(goal - self.goal).max() > 1e-9:
            self.legs.append(float(np.linalg.norm(goal - place)))
            self.planned = -REPLAN_TICKS
        if tick - self.planned >= REPLAN_TICKS:
            self.goal, self.planned = goal.copy(), tick
            self.path = way(place, goal, self.boxes, LOADED_CLEARANCE_UNITS if holds else CLEARANCE_UNITS)
        while len(self.path) > 1 and np.linalg.norm(self.path[0] - place) < REACHED_UNITS:
            self.path.pop(0)
        behind = self.backwards and holds
        x, y = self.path[0] - place
        off = (atan2(y, x) + pi * behind - body[2] + pi) % (2 * pi) - pi
        turn = max(-1.0, min(1.0, 5.0 * off))
        ahead = (1 - abs(turn)) * (-1 if behind else 1) if abs(off) < 0.8 else 0.0
        claw = 0.0 if holds and np.abs(item - zone).max() <= 5 else 1.0
        return 0.5 + 0.5 * (ahead - turn), 0.5 + 0.5 * (ahead + turn), claw


def driven(runs: int, backwards: bool) -> tuple[Array, float, float]:
    """Objects of each run, the mean leg in units, and the mean speed."""
    graph = graph_of(load(COLLECT))
    worlds = Commanded(graph, "Collect", "Collect", runs, np.arange(1, runs + 1), interrupt=False)
    names = [actuator.name for actuator in graph.actuators]
    wheels = [names.index(name) for name in ("left_wheel", "right_wheel", "claw")]
    state, task = worlds.state, next(task for task in graph.tasks if task.name == "Collect")
    drivers = [Driver(state.world.boxes[p].reshape(-1, 4)[:, :3].copy(), backwards) for p in range(runs)]
    speed = 0.0
    for tick in range(task.ticks):
        commands = [
            driver.drive(
                tick,
                state.world.body[:, p],
                state.world.things[0:2, p],
                state.world.things[4:6, p],
                state.world.held[p] >= 0,
            )
            for p, driver in enumerate(drivers)
        ]
        speed += float(np.hypot(state.world.body[3, :runs], state.world.body[4, :runs]).mean()) / task.ticks
        worlds.step(wheels, np.clip(np.array(commands).T, 0, 1))
        if tick < task.ticks - 1:
            worlds.sense()
    legs = [leg for driver in drivers for leg in driver.legs[:-1]]
    return worlds.jobs.counts[:runs, list(task.counts)].sum(axis=1).astype(float), float(np.mean(legs)), speed


def delivered(name: str, runs: int) -> Array:
    """Objects of each run under a shipped mind, on the same layouts; collisions end nothing."""
    ready = shipped(name)
    rollout = Rollout(ready.policy, "Collect", ready.policy.graph.master, interrupt=False)
    none = np.zeros((1, 0), np.float32)
    objects: Array = rollout.score(none, [*range(1, runs + 1)]).counts[0].astype(float)
    return objects


def main() -> None:
    """Drive and print."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--backwards", action="store_true", help="back into the zone, which saves the turn")
    options = parser.parse_args()
    objects, leg, speed = driven(options.runs, options.backwards)
    fastest = 80 * 2 / (np.pi * 1.0**2 * 2.0) / 5.0  # thrust of both wheels ÷ mass ÷ damping
    print(
        f"{'driver who knows everything':<32}{said(objects)} objects, mean speed {speed:.2f}, mean leg {leg:.1f} units"
    )
    print(
        f"{'no turns, no detours':<32}{RUN_SECONDS * fastest / (2 * leg):6.1f} objects at {fastest:.2f} units a second"
    )
    for name in ("collect.mind", "on_the_job.mind", "best.mind"):
        print(f"{name:<32}{said(delivered(name, options.runs))} objects")


def said(numbers: Array) -> str:
    """The mean with its standard error."""
    return f"{numbers.mean():6.1f} ± {numbers.std(ddof=1) / len(numbers) ** 0.5:.1f}"


if __name__ == "__main__":
    main()
