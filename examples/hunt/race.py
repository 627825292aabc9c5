"""Predators and prey are taught in turns, with a hall of fame or without: python examples/hunt/race.py --seeds 3.

In each round the predators are taught against the prey, then the prey against the predators, each from what it knew.
Without a hall of fame a side meets the newest champion of the other side alone. With one it meets that on half of its
layouts, and on the others any of the earlier champions (Rosin and Belew, 1997). Then the predators of all rounds meet
the prey of all rounds in fresh runs (Cliff and Miller, 1995). What --out has then: the champions of the last round with
a hall of fame, as files for `mindc weights import`, and the tables as a picture.
"""

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.graph.run_scores import Scores as RunScores
from mindrun.graph.skill_sets import genes
from mindrun.numbers.arrays import Doubles
from mindrun.sim.rollout import Rollout
from mindrun.terminal.arguments import whole
from mindrun.train.attempt import generation
from mindrun.train.lesson_state import Course, begin_attempt
from mindrun.train.population import Genomes
from mindrun.train.scoring import Purpose, WrappedScorer, layouts

import mindlang
from mindlang.weights.network import network_of, to_bytes

FILE = Path(__file__).with_name("hunt.mind")
SIDES = "Hunt", "Flee"  # the skill of each, which is in charge of the task of its name
HALL = "with a hall of fame"
WAYS = {"in turns alone": False, HALL: True}
FIELDS = tuple(each.name for each in fields(RunScores))
Champions = Mapping[str, list[Genomes]]  # of each side, those [1, weights] of all rounds


class Against(WrappedScorer):
    """A scorer of one side's genomes: on each layout against the one of the opponents that its seed names.

    The rollout's genomes are those of both sides, one behind the other.
    """

    def __init__(self, rollout: Rollout, side: str, opponents: Sequence[Genomes]) -> None:
        super().__init__(rollout)
        self._is_second, self._opponents = side != SIDES[0], opponents
        first = genes(rollout.learners[0])
        own = slice(first, None) if self._is_second else slice(first)
        self.learners = tuple(skill for skill in rollout.learners if skill.name == side)
        self.genome_length = genes(self.learners[0])
        self.draw = lambda count, rng: rollout.draw(count, rng)[:, own]

    def score(self, genomes: Any, seeds: Any, *, ticks: int | None = None) -> RunScores:
        """Every genome on every seed; a result depends on nothing else."""
        named = np.asarray(seeds, np.uint64) % np.uint64(len(self._opponents))
        parts, there = [], list[int]()
        for number in np.unique(named):
            met = np.flatnonzero(named == number)
            pairs = paired(self._is_second, genomes, self._opponents[number])
            parts.append(self.rollout.score(pairs, np.asarray(seeds)[met], ticks=ticks))
            there += met.tolist()
        back = np.argsort(there)
        joined = {name: np.concatenate([getattr(part, name) for part in parts], axis=1)[:, back] for name in FIELDS}
        return RunScores(**joined)


def drawn_from(champions: Sequence[Genomes], with_hall: bool) -> Sequence[Genomes]:
    """What a side's opponents are drawn from: the newest, and with a hall of fame as often any of those before it."""
    newest, earlier = champions[-1], champions[:-1] if with_hall else []
    return [*earlier, *[newest] * max(1, len(earlier))]


def paired(is_second: bool, genomes: Genomes, opponent: Genomes) -> Genomes:
    """Each of a side's genomes before the opponent's [1, weights], or behind it, as the rollout takes them."""
    others = np.repeat(opponent, len(genomes), axis=0)
    return np.concatenate([others, genomes] if is_second else [genomes, others], axis=1)


@dataclass(frozen=True, slots=True)
class Race:
    """A race of a mind's two skills: `rollouts` are of the task of each, with genomes of both."""

    mind: mindlang.Mind
    rollouts: Mapping[str, Rollout]
    rounds: int
    seed: int

    def run(self, with_hall: bool) -> Champions:
        """The champions of all rounds; the first predators are taught against prey with random weights."""
        nobody = Against(self.rollouts["Flee"], "Flee", ()).draw(1, np.random.default_rng(self.seed))
        champions: dict[str, list[Genomes]] = {"Hunt": [], "Flee": []}
        for number in range(self.rounds):
            for side, other in (SIDES, SIDES[::-1]):
                opponents = drawn_from(champions[other] or [nobody], with_hall)
                champions[side].append(self.teach(side, number, champions[side][-1:], opponents))
        return champions

    def teach(self, side: str, number: int, known: Sequence[Genomes], opponents: Sequence[Genomes]) -> Genomes:
        """The champion [1, weights] of a round of one side, which goes on from what it knew."""
        scorer = Against(self.rollouts[side], side, opponents)
        lesson = next(each for each in self.mind.graph.lessons if each.task == side)
        start = known[0] if known else np.empty((0, scorer.genome_length), np.float32)
        course = Course(lesson, self.seed, start)
        state = begin_attempt(course)
        for _ in range(lesson.generations):
            state, _ = generation(course, scorer, 2 * number + SIDES.index(side), state)
        return state.champion

    def catches(self, champions: Champions, runs: int) -> Doubles:
        """The share of fresh runs in which the predators of a round (row) catch the prey of a round (column)."""
        seeds = layouts(self.seed, 0, 0, runs, Purpose.COMPARISON)
        scored = (Against(self.rollouts["Hunt"], "Hunt", [prey]) for prey in champions["Flee"])
        counts = [each.score(np.concatenate(champions["Hunt"]), seeds).counts for each in scored]
        return np.stack([(each > 0).mean(axis=1) for each in counts], axis=1)


def table(catches: Doubles) -> str:
    """A table of catches in percent, and their means."""
    percent = 100 * catches
    head = ["predators, prey of round", *map(str, range(1, len(percent) + 1)), "mean"]
    rows = [[f"of round {number}", *row, row.mean()] for number, row in enumerate(percent, 1)]
    rows.append(["mean", *percent.mean(axis=0), percent.mean()])
    lines = [[cell if isinstance(cell, str) else f"{cell:.0f}" for cell in row] for row in (head, *rows)]
    return "\n".join(line[0].ljust(24) + "".join(cell.rjust(5) for cell in line[1:]) for line in lines)


def progress(catches: Doubles) -> str:
    """How the last of both sides do against each that the other side had before."""
    least, most = catches[-1, :-1].min(), catches[:-1, -1].max()
    theirs = f"earlier predators the last prey in at most {most:.0%}"
    return f"the last predators catch each earlier prey in at least {least:.0%} of the runs, {theirs}"


def crossed(race: Race, champions: Mapping[str, Champions], runs: int) -> str:
    """What the last predators of each way catch of the prey of all rounds of each way."""
    lines = []
    for way, found in champions.items():
        last = {"Hunt": found["Hunt"][-1:]}
        shares = (race.catches({**last, "Flee": each["Flee"]}, runs).mean() for each in champions.values())
        said = (f"{share:.0%} of all prey {of}" for share, of in zip(shares, champions, strict=True))
        lines.append(f"the last predators {way} catch {' and '.join(said)}\n")
    return "".join(lines)


def draw(tables: Mapping[str, Doubles], path: Path) -> None:
    """The tables side by side, as a picture."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 5), layout="constrained")
    for axes, (way, catches) in zip(figure.subplots(1, len(tables), squeeze=False)[0], tables.items(), strict=True):
        axes.imshow(catches, cmap="RdYlBu_r", vmin=0, vmax=1)
        rounds = range(len(catches))
        for row, column in np.ndindex(catches.shape):
            axes.text(column, row, f"{100 * catches[row, column]:.0f}", ha="center", va="center", fontsize=8)
        axes.set(title=f"{way}: caught, in %", xlabel="prey of round", ylabel="predators of round")
        axes.set(xticks=rounds, yticks=rounds, xticklabels=[n + 1 for n in rounds], yticklabels=[n + 1 for n in rounds])
    figure.savefig(path, dpi=100)


def main() -> None:
    """Run the races, print their tables, and keep what they come to."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=whole(1, 1000), default=3, help="how many")
    parser.add_argument("--first", type=whole(0, 2**32), default=1, help="the first of them")
    parser.add_argument("--rounds", type=whole(2, 100), default=8)
    parser.add_argument("--runs", type=whole(1, 100_000), default=100, help="of each predators against each prey")
    parser.add_argument("--workers", type=whole(1, 1024), default=2, help="threads")
    parser.add_argument("--out", type=Path, default=Path("runs/hunt"), help="default: runs/hunt")
    said = parser.parse_args()
    said.out.mkdir(parents=True, exist_ok=True)
    mind = mindlang.load(FILE)
    rollouts = {side: mind.rollout(side, side, SIDES, said.workers) for side in SIDES}
    for seed in range(said.first, said.first + said.seeds):
        race = Race(mind, rollouts, said.rounds, seed)
        champions = {way: race.run(with_hall) for way, with_hall in WAYS.items()}
        tables = {way: race.catches(found, said.runs) for way, found in champions.items()}
        for way, catches in tables.items():
            print(f"seed {seed}, {way}: {progress(catches)}\n{table(catches)}\n")
        print(crossed(race, champions, said.runs), flush=True)
        draw(tables, said.out / f"race-{seed}.png")
        for side, found in champions[HALL].items():
            kept = to_bytes(network_of(mind.graph, side), found[-1][0])
            (said.out / f"{side}-{seed}.safetensors").write_bytes(kept)


if __name__ == "__main__":
    main()
