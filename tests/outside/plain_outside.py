"""A mind in an environment computed the slow and obvious way: what an `EnvironmentRollout` is held against."""

from collections import deque
from typing import Any

import gymnasium
import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph, Task
from mindrun.graph.policy import Policy
from mindrun.kinds.events.event import ItsEnd
from mindrun.sim.codes import BROKEN_OFF, GOING_ON

from tests.outside.drawn_worlds import inside
from tests.plain import f, postfix


class PlainOutside:
    """One run of a task. Which of its actuators fail, and when, is told; so is what noise made of a reading."""

    def __init__(self, graph: Graph, weights: Any, task: Task, master: str, seed: int) -> None:
        self.graph, self.task = graph, task
        self.engine = Engine(Policy(graph, weights), None, master)
        self.world: Any = gymnasium.make(task.scene.environment, max_episode_steps=-1).unwrapped
        self.observed, _ = self.world.reset(seed=seed % (1 << 31))
        self.late = [deque([f(each.kind.neutral)] * each.kind.delay) for each in graph.actuators]
        self.history: dict[int, list[float]] = {}
        self.counts = [0] * len(task.events)
        self.lines = [np.float64(0)] * len(task.rewards)
        self.ticks, self.ended, self.met, self.is_over = 0, GOING_ON, GOING_ON, False

    def readings(self) -> dict[int, list[tuple[float, float]]]:
        """Of each reading that is observed, by its number, the (least, most) that it may be: late, noisy, lost."""
        found = {}
        for sensor in self.graph.sensors:
            if (slot := sensor.kind.slot) is None:
                continue
            for row, number in enumerate(numbers_at(self.observed, slot), sensor.start):
                value = float(number)
                share = min(1.0, max(0.0, (value - slot.range.first) / (slot.range.last - slot.range.first)))
                past = self.history.setdefault(row, [])
                past.append(share)
                kind = sensor.kind
                seen = past[max(0, self.ticks - kind.delay) // max(1, kind.every) * max(1, kind.every)]
                spans = [(max(0.0, seen - kind.noise), min(1.0, seen + kind.noise))]
                found[row] = [*spans, (0.0, 0.0)] if kind.lost else spans
        return found

    def step(self, readings: Any, failing: dict[str, int]) -> tuple[list[Any], list[int]]:
        """One tick with these readings: the commands as they act, and how often each event happened."""
        commands = []
        for late, command in zip(self.late, self.engine.tick(readings), strict=True):
            late.append(command)
            commands.append(late.popleft())
        acting = [
            f(each.kind.neutral) if self.ticks >= failing.get(each.name, self.ticks + 1) else command
            for each, command in zip(self.graph.actuators, commands, strict=True)
        ]
        action = self.formed(self.world.action_space, acting)
        self.observed, reward, terminated, truncated, _ = self.world.step(action)
        happened = [int(terminated and isinstance(event, ItsEnd)) for event in self.task.events]
        self.judge(happened, readings, float(reward), [float(command) for command in commands])
        self.ticks += 1
        if self.ended == GOING_ON and (terminated or truncated):
            self.ended = BROKEN_OFF
        self.is_over = self.ended != GOING_ON or self.ticks == self.task.ticks
        return acting, happened

    def judge(self, happened: list[int], readings: Any, reward: float, commands: list[float]) -> None:
        """Whether one of the task's ends has come, and what each line pays."""

        def value(program: Any) -> Any:
            words = {"measure": lambda _: ("number", reward), "command": lambda i: ("number", commands[i])}
            return postfix([words.get(word, lambda i, word=word: (word, i))(i) for word, i in program], readings)

        self.counts = [count + it for count, it in zip(self.counts, happened, strict=True)]
        for number, end in enumerate(self.task.ends):
            if end.when is not None:
                has_come = value(end.when) > 0
            else:
                has_come = happened[end.event] > 0 and self.counts[end.event] >= end.times
            if has_come:
                self.ended = self.met = number
                for i, event in enumerate(self.task.events):
                    others = [event.within.of] if event.within else []  # its end, after which no tick comes
                    is_soon = all(happened[self.task.events.index(other)] for other in others)
                    happened[i] += int(end.succeeds and not isinstance(event, ItsEnd) and is_soon)
                    self.counts[i] += int(end.succeeds and not isinstance(event, ItsEnd) and is_soon)
                break
        for i, line in enumerate(self.task.rewards):
            if (line.on is None or happened[line.on]) and (line.when is None or value(line.when) > 0):
                self.lines[i] = self.lines[i] + value(line.amount) * (1 if line.on is None else happened[line.on])

    def formed(self, space: Any, commands: list[Any], path: tuple[Any, ...] = ()) -> Any:
        """The action that the commands make."""
        if isinstance(space, gymnasium.spaces.Dict):
            return {key: self.formed(inner, commands, (*path, key)) for key, inner in space.spaces.items()}
        if isinstance(space, gymnasium.spaces.Tuple):
            return tuple(self.formed(inner, commands, (*path, number)) for number, inner in enumerate(space.spaces))
        values = np.zeros(space.shape, space.dtype)
        best: dict[Any, Any] = {}
        for actuator, command in zip(self.graph.actuators, commands, strict=True):
            slot = actuator.kind.slot
            keys = (*(slot.part.split(".") if slot.part else ()), *slot.index)
            if keys[: len(path)] != path:
                continue
            index = () if not space.shape else keys[len(path) :]
            if slot.chosen is None:
                low, high = (
                    (slot.range.first, slot.range.last)
                    if slot.range
                    else (float(space.low[index]), float(space.high[index]))
                )
                values[index] = np.float64(low) + np.float64(command) * (np.float64(high) - np.float64(low))
            elif index not in best or command > best[index]:
                best[index], values[index] = command, slot.chosen
        return values[()] if isinstance(space, gymnasium.spaces.Discrete) else values


def numbers_at(observed: Any, slot: Any) -> list[Any]:
    """The number of an observation that a slot names, or its numbers."""
    keys = [*(slot.part.split(".") if slot.part else ()), *slot.index]
    while isinstance(observed, dict | tuple):
        observed = inside(observed, (keys.pop(0),))
    if slot.last is not None:
        return [*np.asarray(observed).flatten()[keys[0] if keys else 0 : slot.last + 1]]
    return [np.asarray(observed)[tuple(keys)] if np.ndim(observed) else np.asarray(observed)[()]]
