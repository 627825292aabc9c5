"""The Collect task as a user would write it today: one pymunk Space per robot, numpy perceptrons, a Python loop."""

import math
from collections.abc import Mapping

import numpy as np
import pymunk
from mindrun.graph.graph import Graph, Skill
from mindrun.kinds.functions.mlp import Mlp
from mindrun.numbers.network import matrices
from mindrun.sim.trace import Trace
from numpy.typing import NDArray

TICK_SECONDS, HALF_SIDE, CLAW_REACH, SENSOR_RANGE = 1 / 60, 50.0, 1.5, 12.0
ANGLES = np.radians([0, 22.5, 45, 90, 135, 180, 225, 270, 315, 337.5])
LINEAR, ANGULAR = 1 / (1 + TICK_SECONDS * 5), 1 / (1 + TICK_SECONDS * 20)
ROBOT = pymunk.ShapeFilter(group=1)  # rays do not meet the robot itself


class Robot:
    """One robot in a world of its own, with its mind."""

    def __init__(self, graph: Graph, weights: Mapping[str, NDArray[np.float32]], layout: Trace, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.space = pymunk.Space()
        self.space.iterations = 8
        for x, y, half, _ in layout.boxes:
            self._box(x - half, y - half, x + half, y + half)
        for walls in ((-51, -51, -50, 51), (50, -51, 51, 51), (-51, -51, 51, -50), (-51, 50, 51, 51)):
            self._box(*walls)
        self.body = pymunk.Body(2 * math.pi, math.pi)
        self.body.position, self.body.angle = tuple(layout.begin[:2]), layout.begin[2]
        circle = pymunk.Circle(self.body, 1.0)
        circle.filter, circle.friction = ROBOT, 0.2
        self.space.add(self.body, circle)
        self.item, self.zone = layout.things[0, :2].copy(), layout.things[1, :2].copy()
        self.holding, self.time, self.score = False, 0, 0.0
        self.trail = [self.body.position] * 20
        self.bearings = np.array([0.5, 0.5])
        self.starts = {sensor.name: sensor.start for sensor in graph.sensors}
        self.readings = np.zeros(graph.width, np.float32)
        self.minds = [(skill, np.array(skill.inputs), _layers(skill, weights)) for skill in graph.skills]
        self.skills = [skill.name for skill in graph.skills]

    def _box(self, left: float, low: float, right: float, high: float) -> None:
        corners = [(left, low), (right, low), (right, high), (left, high)]
        box = pymunk.Poly(self.space.static_body, corners)
        box.friction = 1.0
        self.space.add(box)

    def tick(self) -> None:
        """Sense, think, act, step, judge."""
        self.sense()
        self.act(*self.think())
        before = self.distances()
        self.space.step(TICK_SECONDS)
        self.judge(before)
        self.time += 1

    def sense(self) -> None:
        """Fill the readings: ten rays, two bearings and their changes, four switches, a clock."""
        x, y = self.body.position
        readings, at = self.readings, self.starts
        for i, turn in enumerate(ANGLES + self.body.angle):
            way = math.cos(turn), math.sin(turn)
            end = x + way[0] * (SENSOR_RANGE + 1), y + way[1] * (SENSOR_RANGE + 1)
            hit = self.space.segment_query_first((x, y), end, 0.0, ROBOT)
            readings[at["proximity"] + i] = (
                max(0.0, (hit.alpha * (SENSOR_RANGE + 1) - 1) / SENSOR_RANGE) if hit else 1.0
            )
        bearings = np.array([self.bearing(self.item), self.bearing(self.zone)])
        change = (bearings - self.bearings + 0.5) % 1.0 - 0.5
        readings[at["object_bearing"]], readings[at["drop_zone_bearing"]] = bearings
        drift = np.clip(0.5 + change / (2 * TICK_SECONDS), 0.0, 1.0)
        readings[at["object_drift"]], readings[at["drop_zone_drift"]] = drift
        self.bearings = bearings
        readings[at["object_in_reach"]] = self.in_reach()
        readings[at["in_drop_zone"]] = np.abs(self.zone - (x, y)).max() < 5
        readings[at["holding"]] = self.holding
        readings[at["moving"]] = min(1.0, math.dist(self.trail[0], (x, y)) / (20 * TICK_SECONDS))
        readings[at["pulse"]] = 0.5 + 0.5 * math.sin(2 * math.pi * self.time * TICK_SECONDS / 2)
        self.trail = [*self.trail[1:], self.body.position]

    def bearing(self, place: NDArray[np.float64]) -> float:
        """0.5 straight ahead, the seam behind."""
        x, y = self.body.world_to_local(tuple(place))
        return 0.5 - math.atan2(y, x) / (2 * math.pi)

    def in_reach(self) -> bool:
        """Whether the claw can take the item."""
        x, y = self.body.world_to_local(tuple(self.item))
        return x >= 1 and math.hypot(x - 1, y) <= CLAW_REACH + 0.5

    def think(self) -> tuple[float, float, float]:
        """Influence from the master down, then the wheels' and the claw's commands."""
        influence = dict.fromkeys(self.skills, 0.0)
        influence["Collect"] = 1.0
        total, weight = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        for skill, inputs, matrix in self.minds:
            own = influence[skill.name]
            if own == 0.0:
                continue
            outputs = perceive(matrix, self.readings[inputs]) if matrix else [self.grab()]
            for edge in skill.edges:
                value = 1.0 if edge.output is None and edge.to == "skill" else float(outputs[edge.output or 0])
                if edge.to == "skill":
                    influence[self.skills[edge.target]] += value * own
                else:
                    total[edge.target] += value * own
                    weight[edge.target] += own
        left, right, claw = (t / w if w else n for t, w, n in zip(total, weight, (0.5, 0.5, 0.0), strict=True))
        return left, right, claw

    def grab(self) -> float:
        """The rule of the skill Grab."""
        reach, holding, zone = (
            self.readings[self.starts[name]] for name in ("object_in_reach", "holding", "in_drop_zone")
        )
        return min(1.0, float((reach + holding) * (1 - zone)))

    def act(self, left: float, right: float, claw: float) -> None:
        """Wheels push the body; the claw takes the item or lets it go."""
        force, torque = (2 * left - 1) * 80 + (2 * right - 1) * 80, (2 * right - 1) * 80 - (2 * left - 1) * 80
        self.body.velocity *= LINEAR
        self.body.angular_velocity *= ANGULAR
        self.body.apply_force_at_local_point((force, 0))
        self.body.torque += torque
        self.holding = claw > 0.5 and (self.holding or self.in_reach())

    def distances(self) -> tuple[float, float]:
        """From the robot to the item and to the zone."""
        return math.dist(self.body.position, self.item), math.dist(self.body.position, self.zone)

    def judge(self, before: tuple[float, float]) -> None:
        """Carry the item, pay the rewards, and place a delivered item anew."""
        if self.holding:
            self.item[:] = self.body.local_to_world((1.5, 0))
            if np.abs(self.item - self.zone).max() < 5:
                self.score += 30
                self.holding = False
                self.item[:] = self.rng.uniform(-HALF_SIDE + 2, HALF_SIDE - 2, 2)
        closed = before[self.holding] - self.distances()[self.holding]
        self.score += 0.001 * closed if closed > 0 else 0.0005 * closed


def _layers(skill: Skill, weights: Mapping[str, NDArray[np.float32]]) -> tuple[NDArray[np.float32], ...]:
    if not isinstance(skill.function, Mlp):
        return ()
    return matrices(weights[skill.name], skill.function.layers(len(skill.inputs), skill.outputs))


def perceive(layer_matrices: tuple[NDArray[np.float32], ...], values: NDArray[np.float32]) -> NDArray[np.float32]:
    """A perceptron with sigmoid hidden layers and a clamped last one."""
    *hidden, last = layer_matrices
    for matrix in hidden:
        values = 1 / (1 + np.exp(-np.dot(matrix, values)))
    sent: NDArray[np.float32] = np.clip(np.dot(last, values), 0.0, 1.0)
    return sent
