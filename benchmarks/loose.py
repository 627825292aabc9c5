"""Worlds with ten boxes that can be pushed, beside a plain pymunk loop and beside the same world with ten fixed ones.

    python benchmarks/loose.py [rounds]

The robot drives about, or pushes one of them all the time; plain pymunk steps eleven bodies, asks five rays and
computes the same rule. In the last ones it turns on the spot, where it touches nothing. All in one thread, in turns.
"""

import math
import sys
from time import perf_counter

import numpy as np
import pymunk
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Trace, trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

RUN_TICKS, LAYOUT_COUNT, PLAIN_TICKS, ROUND_COUNT = 5_000, 256, 5_000, 5
TICK_SECONDS, HALF_ARENA_UNITS, RANGE_UNITS, SIZE_UNITS, CRATE_DENSITY = 1 / 60, 25.0, 12.0, 2.0, 0.5
ANGLES = np.radians([0, 30, -30, 90, -90])
MIND = """
tick 1/60 s
master Push
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eyes is range_finder at 0 30 -30 90 -90 deg range 12
sensor crate_bearing is bearing of crate_1
sensor beat is sine period 7 s
skill Push is rule
  reads eyes
  reads crate_bearing
  reads beat
  drives left_wheel at LEFT
  drives right_wheel at RIGHT
task World in arena size 50
THINGS
  lasts RUN_TICKS ticks
  rewards progress toward crate_1 per tick
"""
Rule = tuple[float, float, float]
DRIVING_WEIGHTS, PUSHING_WEIGHTS = (
    (1.3, 0.3, 1.0),
    (1.2, 0.0, 3.0),
)  # how much of the beat, more to the left, towards the crate
TURNING = "0.2", "0.8"


def wheels(beat: float, more: float, steering: float) -> tuple[str, str]:
    """The commands of both wheels."""
    steered = f"{steering} * (crate_bearing - 0.5)"
    return f"{beat} * beat + {more} + {steered}", f"{beat} * beat - {steered}"


LOOSE_THINGS = [f"crate_{i} is box size 2 density 0.5" for i in range(1, 11)]
ZONE = ["home is zone size 6"]
FIXED_THINGS = ["crate_1 is item size 2", "rock is obstacle size 2 count 10"]


def world(commands: tuple[str, str], things: list[str]) -> Rollout:
    """A world with these things, in which the wheels get these commands."""
    text = MIND.replace("LEFT", commands[0]).replace("RIGHT", commands[1]).replace("RUN_TICKS", str(RUN_TICKS))
    lines = "\n".join(f"  contains {thing}" for thing in things)
    graph: Graph | None = compile_source(Source("loose.mind", text.replace("THINGS", lines))).graph
    assert graph
    return Rollout(Policy(graph, {}), "World", "Push")


def rate(rollout: Rollout) -> float:
    """Agent-ticks per second in one thread."""
    begun = perf_counter()
    ticks = rollout.score(np.zeros((1, 0), np.float32), range(LAYOUT_COUNT)).ticks.sum()
    return float(ticks) / (perf_counter() - begun)


class Plain:
    """The pushing robot as a user would write it: one Space, a Python loop."""

    def __init__(self, layout: Trace, rule: Rule) -> None:
        self.rule = rule
        self.space = pymunk.Space()
        self.space.iterations = 8
        for a, b, c, d in ((-26, -26, -25, 26), (25, -26, 26, 26), (-26, -26, 26, -25), (-26, 25, 26, 26)):
            wall = pymunk.Poly(self.space.static_body, [(a, b), (c, b), (c, d), (a, d)])
            wall.friction = 1.0
            self.space.add(wall)
        self.own = pymunk.ShapeFilter(group=1)
        self.body = pymunk.Body(2 * math.pi, math.pi)
        self.body.position, self.body.angle = tuple(layout.begin[:2]), layout.begin[2]
        circle = pymunk.Circle(self.body, 1.0)
        circle.filter, circle.friction = self.own, 0.2
        self.space.add(self.body, circle)
        self.crates = [self._crate(*place) for place in layout.things[:, :2].tolist()]
        self.time, self.score, self.near = 0, 0.0, 0.0

    def _crate(self, x: float, y: float) -> pymunk.Body:
        mass = CRATE_DENSITY * SIZE_UNITS**2
        body = pymunk.Body(mass, pymunk.moment_for_box(mass, (SIZE_UNITS, SIZE_UNITS)))
        body.position = x, y
        shape = pymunk.Poly.create_box(body, (SIZE_UNITS, SIZE_UNITS))
        shape.friction = 0.5
        self.space.add(body, shape)
        return body

    def tick(self) -> None:
        """Sense, think, act, step, judge."""
        (x, y), angle = self.body.position, self.body.angle
        eyes = []
        for turn in ANGLES + angle:
            end = x + math.cos(turn) * (RANGE_UNITS + 1), y + math.sin(turn) * (RANGE_UNITS + 1)
            hit = self.space.segment_query_first((x, y), end, 0.0, self.own)
            eyes.append(max(0.0, (hit.alpha * (RANGE_UNITS + 1) - 1) / RANGE_UNITS) if hit else 1.0)
        ahead, aside = self.body.world_to_local(self.crates[0].position)
        bearing, beat = (
            0.5 - math.atan2(aside, ahead) / (2 * math.pi),
            0.5 + 0.5 * math.sin(2 * math.pi * self.time * TICK_SECONDS / 7),
        )
        of_beat, more, steering = self.rule
        left = min(1.0, max(0.0, of_beat * beat + more + steering * (bearing - 0.5)))
        right = min(1.0, max(0.0, of_beat * beat - steering * (bearing - 0.5)))
        self.body.velocity *= 1 / (1 + TICK_SECONDS * 5)
        self.body.angular_velocity *= 1 / (1 + TICK_SECONDS * 20)
        for crate in self.crates:
            crate.velocity *= 1 / (1 + TICK_SECONDS * 5)
            crate.angular_velocity *= 1 / (1 + TICK_SECONDS * 5)
        self.body.apply_force_at_local_point(((2 * left - 1) * 80 + (2 * right - 1) * 80, 0))
        self.body.torque += (2 * right - 1) * 80 - (2 * left - 1) * 80
        before = self.body.position.get_distance(self.crates[0].position)
        self.space.step(TICK_SECONDS)
        self.score += before - self.body.position.get_distance(self.crates[0].position)
        self.time += 1


def plain_rate(rollout: Rollout, rule: Rule, seed: int) -> float:
    """Ticks per second of the plain loop."""
    robot = Plain(trace(rollout, seed), rule)
    begun = perf_counter()
    for _ in range(PLAIN_TICKS):
        robot.tick()
    return PLAIN_TICKS / (perf_counter() - begun)


def main(rounds: int) -> None:
    """Medians over so many rounds of turns."""
    driving, pushing = (world(wheels(*rule), LOOSE_THINGS) for rule in (DRIVING_WEIGHTS, PUSHING_WEIGHTS))
    loose, fixed = world(TURNING, LOOSE_THINGS), world(TURNING, FIXED_THINGS)
    zoned, fixed_zoned = world(TURNING, LOOSE_THINGS + ZONE), world(TURNING, FIXED_THINGS + ZONE)
    driving.compile()
    rows = [
        (
            *(
                rate(driving),
                plain_rate(driving, DRIVING_WEIGHTS, seed),
                rate(pushing),
                plain_rate(pushing, PUSHING_WEIGHTS, seed),
            ),
            *(rate(loose), rate(fixed), rate(zoned), rate(fixed_zoned)),
        )
        for seed in range(rounds)
    ]
    found = np.array(rows)
    drive, plain, push, plainly, still, rocks, by_zone, rocks_by_zone = np.median(found, axis=0)
    ratios = np.median(found[:, ::2] / found[:, 1::2], axis=0)
    print(f"driving among ten boxes    {drive:12,.0f} agent-ticks/s/core")
    print(f"  plain pymunk loop        {plain:12,.0f}   {ratios[0]:.1f} times as fast in the lanes")
    print(f"pushing one all the time   {push:12,.0f}")
    print(f"  plain pymunk loop        {plainly:12,.0f}   {ratios[1]:.1f} times")
    print(f"ten loose, none touched    {still:12,.0f}")
    print(f"  ten fixed                {rocks:12,.0f}   loose: {ratios[2]:.2f} of that")
    print(f"the same beside a zone     {by_zone:12,.0f}")
    print(f"  ten fixed                {rocks_by_zone:12,.0f}   loose: {ratios[3]:.2f} of that")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else ROUND_COUNT)
