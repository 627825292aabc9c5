"""Gradients instead of genes: python benchmarks/gradients.py [--skill GoToObject] [--ticks 4e6] [--seeds 5].

PPO (Schulman et al., 2017) in the skill's own function class, a perceptron without biases, with numpy alone: 64 lanes
are its environments, a command is held for some ticks, the critic is a network of its own that the skill never sees.
Each quarter of the ticks the weights as they stand run on 100 layouts that the training has not seen.
"""

import argparse
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from itertools import pairwise
from typing import Self

import numpy as np
from mindrun.kinds.functions.mlp import Mlp
from mindrun.numbers.network import matrices
from mindrun.train.population import MAX_WEIGHT, Genomes
from numpy.typing import NDArray

from benchmarks.commanded import Commanded
from benchmarks.learning import FRESH_LAYOUTS, prepared
from benchmarks.workloads import collect

LANE_COUNT, ROLLOUT_STEPS, EPOCH_COUNT, BATCH_SIZE = 64, 128, 6, 1024
DISCOUNT_FACTOR, TRACE_DECAY, CLIP_RATIO = 0.99, 0.95, 0.2
CRITIC_LAYERS, CRITIC_RATE = (64, 64), 1e-3
SPREAD_RATE = 3e-3  # steps of the spread
Array = NDArray[np.float64]


class Worlds:
    """A skill's lesson in lanes, which begin anew when a run ends; whoever uses it sends the skill's commands."""

    def __init__(self, skill: str, hold: int, rng: np.random.Generator) -> None:
        graph, _, _ = collect()
        self.skill = next(each for each in graph.skills if each.name == skill)
        self.hold, self.ticks = hold, 0
        lesson = next(each for each in graph.lessons if each.skill == skill)
        seeds = rng.integers(2**62, size=100_000)
        self._worlds = Commanded(graph, lesson.task, lesson.master, LANE_COUNT, seeds, interrupt=True)
        self._job, self._paid = self._worlds.state.run.job.copy(), np.zeros(LANE_COUNT)

    def inputs(self) -> Array:
        """What the skill reads [lanes, inputs]."""
        return self._worlds.state.mind.readings[list(self.skill.inputs), :LANE_COUNT].T.astype(np.float64)

    def step(self, commands: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Hold commands [lanes, outputs] for some ticks: what they earned [lanes], and in which lanes a run ended."""
        state, lines = self._worlds.state, self._worlds.jobs.lines
        earned, ended = np.zeros(LANE_COUNT), np.zeros(LANE_COUNT, bool)
        for _ in range(self.hold):
            self._worlds.step([edge.target for edge in self.skill.edges], np.clip(commands, 0, 1).T)
            self.ticks += LANE_COUNT
            paid, over = state.judge.lines[:, :LANE_COUNT].sum(axis=0), state.run.job != self._job
            earned += np.where(over, lines[self._job].sum(axis=1), paid) - self._paid
            ended |= over
            self._paid, self._job = paid, state.run.job.copy()
            self._worlds.sense()
        return earned, ended


class Network:
    """Layers of matrices [out, in] that learn by Adam; sigmoid or tanh between them, the last one linear."""

    def __init__(self, weights: list[Array], biased: bool) -> None:
        self.weights, self._biased, self._steps = weights, biased, 0
        self._moments = [(np.zeros_like(w), np.zeros_like(w)) for w in weights]
        self._values: list[Array] = []

    def forward(self, values: Array) -> Array:
        """The outputs [rows, out]; what `backward` needs is kept."""
        self._values = []
        for i, matrix in enumerate(self.weights):
            if self._biased:
                values = np.concatenate([values, np.ones((len(values), 1))], axis=1)
            self._values.append(values)
            values = values @ matrix.T
            if i < len(self.weights) - 1:
                values = np.tanh(values) if self._biased else 1 / (1 + np.exp(-values))
        return values

    def backward(self, slope: Array, rate: float) -> None:
        """One step of Adam down the slope [rows, out] of a loss by the outputs of the last `forward`."""
        gradients = []
        for i in range(len(self.weights) - 1, -1, -1):
            gradients.append(slope.T @ self._values[i])
            slope = slope @ self.weights[i]
            if self._biased:
                slope = slope[:, :-1]
            if i:
                seen = self._values[i][:, : slope.shape[1]]
                slope = slope * (1 - seen * seen if self._biased else seen * (1 - seen))
        self._steps += 1
        for matrix, moments, gradient in zip(self.weights, self._moments, reversed(gradients), strict=True):
            matrix -= adam(moments, gradient, rate, self._steps)


def adam(moments: tuple[Array, Array], gradient: Array, rate: float, steps: int) -> Array:
    """The step that Adam takes (Kingma and Ba, 2015); the moments are brought up to date."""
    mean, square = moments
    mean += 0.1 * (gradient - mean)
    square += 0.001 * (gradient * gradient - square)
    return rate * (mean / (1 - 0.9**steps)) / (np.sqrt(square / (1 - 0.999**steps)) + 1e-8)


@dataclass(slots=True)
class Scale:
    """The running spread of what is still to be earned, by which rewards are divided."""

    count: float = 1e-4
    mean: float = 0.0
    variance: float = 1.0

    def learn(self, values: Array) -> None:
        """Take some more values in."""
        gap, total = float(values.mean()) - self.mean, self.count + len(values)
        both = self.variance * self.count + float(values.var()) * len(values)
        self.variance = (both + gap * gap * self.count * len(values) / total) / total
        self.mean += gap * len(values) / total
        self.count = total


@dataclass(slots=True)
class Learner:
    """PPO: the skill's perceptron as actor, with a spread of its own for each output, and the critic."""

    worlds: Worlds
    actor: Network
    critic: Network
    spread: Array  # logarithms
    rng: np.random.Generator
    rate: float
    scale: Scale = field(default_factory=Scale)

    @classmethod
    def begin(cls, skill: str, hold: int, rate: float, seed: int) -> Self:
        """First weights as a lesson draws them, but for the last layer: noise would change nothing there."""
        rng = np.random.default_rng(seed)
        worlds = Worlds(skill, hold, rng)
        function, count, outputs = worlds.skill.function, len(worlds.skill.inputs), worlds.skill.outputs
        assert isinstance(function, Mlp)
        shape = function.layers(count, outputs)
        first = [matrix.astype(np.float64) for matrix in matrices(function.draw(count, outputs, 1, rng)[0], shape)]
        first[-1] = 1 / shape[-1][0] + 0.1 * rng.standard_normal(first[-1].shape)
        wide = [rng.standard_normal((b, a + 1)) / np.sqrt(a) for a, b in pairwise((count, *CRITIC_LAYERS, 1))]
        actor, critic = Network(first, biased=False), Network(wide, biased=True)
        return cls(worlds, actor, critic, np.full(outputs, np.log(0.3)), rng, rate)

    def learn(self, ticks: float) -> Iterator[tuple[int, Genomes]]:
        """The ticks taken and the skill's weights [1, weights], after each update."""
        moments, steps, coming = (np.zeros_like(self.spread), np.zeros_like(self.spread)), 0, np.zeros(LANE_COUNT)
        while self.worlds.ticks < ticks:
            batch = self.collected(coming)
            for _ in range(EPOCH_COUNT):
                for rows in np.array_split(self.rng.permutation(len(batch.seen)), len(batch.seen) // BATCH_SIZE):
                    steps += 1
                    self.improve(batch.rows(rows), moments, steps)
            genome = np.concatenate([matrix.ravel() for matrix in self.actor.weights])
            yield self.worlds.ticks, np.clip(genome, -MAX_WEIGHT, MAX_WEIGHT).astype(np.float32)[None]

    def collected(self, coming: Array) -> "Batch":
        """Some steps in all lanes; `coming` is what they earned of late, discounted, from batch to batch."""
        seen, done, likely, values, earned, over = [], [], [], [], [], []
        inputs = self.worlds.inputs()
        for _ in range(ROLLOUT_STEPS):
            noise = self.rng.standard_normal((LANE_COUNT, len(self.spread)))
            seen.append(inputs)
            done.append(self.actor.forward(inputs) + np.exp(self.spread) * noise)
            likely.append((-0.5 * noise**2 - self.spread).sum(axis=1))
            values.append(self.critic.forward(2 * inputs - 1)[:, 0])
            paid, ended = self.worlds.step(done[-1])
            coming[:] = DISCOUNT_FACTOR * coming + paid
            self.scale.learn(coming)
            coming[ended] = 0
            earned.append(np.clip(paid / np.sqrt(self.scale.variance + 1e-8), -20, 20))
            over.append(ended)
            inputs = self.worlds.inputs()
        values.append(self.critic.forward(2 * inputs - 1)[:, 0])
        x, a, old, gain = (np.concatenate(part) for part in (seen, done, likely, advantages(earned, over, values)))
        return Batch(x, a, old, gain, gain + np.concatenate(values[:-1]))

    def improve(self, batch: "Batch", moments: tuple[Array, Array], steps: int) -> None:
        """One step of Adam for the actor, the spread and the critic."""
        better = (batch.gain - batch.gain.mean()) / (batch.gain.std() + 1e-8)
        z = (batch.done - self.actor.forward(batch.seen)) / np.exp(self.spread)
        ratio = np.exp((-0.5 * z**2 - self.spread).sum(axis=1) - batch.likely)
        counts = ratio * better <= np.clip(ratio, 1 - CLIP_RATIO, 1 + CLIP_RATIO) * better
        slope = (-better * ratio * counts / len(better))[:, None]
        self.actor.backward(slope * z / np.exp(self.spread), self.rate)
        self.spread -= adam(moments, (slope * (z**2 - 1)).sum(axis=0), min(self.rate, SPREAD_RATE), steps)
        np.clip(self.spread, -3, 0.5, out=self.spread)
        missed = self.critic.forward(2 * batch.seen - 1)[:, 0] - batch.target
        self.critic.backward(missed[:, None] / len(missed), CRITIC_RATE)


@dataclass(frozen=True, slots=True)
class Batch:
    """What was read [rows, inputs] and commanded [rows, outputs], how likely that was, what came of it [rows]."""

    seen: Array
    done: Array
    likely: Array
    gain: Array
    target: Array

    def rows(self, chosen: NDArray[np.int64]) -> "Batch":
        """Some of it."""
        return Batch(*(getattr(self, each.name)[chosen] for each in fields(self)))


def advantages(earned: list[Array], over: list[NDArray[np.bool_]], values: list[Array]) -> list[Array]:
    """How much better than expected each step was (generalised advantage estimation)."""
    gains, last = [], np.zeros(LANE_COUNT)
    for t in range(len(earned) - 1, -1, -1):
        going = 1.0 - over[t]
        last = (
            earned[t]
            + DISCOUNT_FACTOR * values[t + 1] * going
            - values[t]
            + DISCOUNT_FACTOR * TRACE_DECAY * going * last
        )
        gains.append(last)
    return gains[::-1]


def main() -> None:
    """Learn, try, print."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--skill", default="GoToObject")
    parser.add_argument("--ticks", type=float, default=4e6)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--rate", type=float, default=0.03, help="of Adam for the skill's weights")
    parser.add_argument("--hold", type=int, default=6, help="ticks for which a command is held")
    options = parser.parse_args()
    graph, weights, _ = collect()
    _, rollout = prepared(graph, weights, options.skill, 1)
    ends = []
    for seed in range(1, options.seeds + 1):
        begin = time.process_time()
        found: list[float] = []
        learner = Learner.begin(options.skill, options.hold, options.rate, seed)
        for ticks, genome in learner.learn(options.ticks):
            if ticks >= options.ticks * (len(found) + 1) / 4:
                found.append(float(rollout.score(genome, [int(word) for word in FRESH_LAYOUTS]).counts.mean()))
        seconds = time.process_time() - begin
        said = ", ".join(f"{count:.1f}" for count in found)
        print(f"seed {seed:>3}: {said} per run after each quarter, {seconds:.0f} s CPU", flush=True)
        ends.append(found)
    print("mean:     " + ", ".join(f"{count:.1f}" for count in np.mean(ends, axis=0)))


if __name__ == "__main__":
    main()
