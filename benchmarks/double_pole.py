"""Two poles on a cart without velocities: python benchmarks/double_pole.py [--function neat] [--seeds 20].

    --function elman                 `elman width 3 centred 1` by `evolution_strategy`; or a neat by `genetic`
    --says "elman width 4"           another function; what a skill of a mind may say
    --learner "genetic population 100 octaves 2"     another learner; its `patience` begins anew where it is stuck

The task is that of Gruau, Whitley and Pyeatt (1996) as Igel (2003) and Gomez, Schmidhuber and Miikkulainen (2008) have
it: the poles (1 m, 0.1 m) begin with the long one at 4.5 degrees, the cart is pushed with up to 10 N every 0.02 s,
which are two steps of Runge and Kutta of 0.01 s. A genome scores 0.1 t / 1000 + 0.9 · 0.75 / Σ(|x| + |ẋ| + |θ| + |θ̇|),
of the long pole and over the last 100 of t steps, of at most 1000; the second part is 0 where t < 100. It has solved
the task if it is the best of its generation, and holds both poles for 100,000 steps from that start, and for 1000 from
200 of 625 others. Those trials are not counted as evaluations, as in the papers.

The function and the learner are what a mind says, and the function computes as on a robot, to the bit. A seed that
stands in the log is not done again, so whoever is stopped goes on with the next.
"""

import argparse
import json
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from statistics import mean, median
from typing import Any

import numpy as np
from mindrun.graph.graph import Skill
from mindrun.kinds.learners import Learner
from mindrun.numbers.arrays import Doubles
from mindrun.numbers.network import FLOAT32
from mindrun.processors import cores
from mindrun.train.ask_and_tell import ask, tell
from mindrun.train.heredity import Heredity, Part
from mindrun.train.population import Genomes, empty_population, order
from numpy.typing import NDArray

from benchmarks.cart_and_poles import FALLEN_RADIANS, TRACK_M, compiled, tick
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

START = np.array([[0, 0, np.pi / 40, 0, 0, 0]])  # x, its speed, the long pole's angle, its speed, the short one's
LATTICE = np.array([0.05, 0.25, 0.5, 0.75, 0.95])  # shares of the spans of 625 starts
SPANS = np.radians(3.6), np.radians(8.6)  # of the long pole's angle and of its speed, to both sides
SCORED_TICKS, LAST_TICKS, LONG_TICKS, ENOUGH_STARTS = 1000, 100, 100_000, 200

SAYS = {"elman": "elman width 3 centred 1", "neat": "neat most 4 links any bias 0 centred 1"}
LEARNERS = {
    "elman": "evolution_strategy population 16 mutation 0.6 founders 50",
    "neat": (
        "genetic population 1000 elite 2% species 15 octaves 4 mutated 60% grow 3% link 20% patience 25 generations"
    ),
}
PUBLISHED = {
    "elman": "CMA-ES 6,061 (Igel, 2003), CoSyNE 3,416 (Gomez et al., 2008)",
    "neat": "NEAT 33,184 (Stanley and Miikkulainen, 2002), 92,115 and 17 of 20 (genoxide)",
}
MIND = """
tick 1/50 s
master Balance
sensor place is observation 0 range -2.4 to 2.4
sensor long is observation 1 range -0.628 to 0.628
sensor short is observation 2 range -0.628 to 0.628
actuator push is action 0 range -10 to 10 neutral 0.5
skill Balance is {says}
  reads place
  reads long
  reads short
  drives push
task Upright in gymnasium poles:DoublePole-v0
  lasts 1000 ticks
  rewards its reward
curriculum Evolution is {learner}
  teaches Balance on Upright for 100000 generations
"""


@compiled
def product(values: Genomes, matrix: Genomes) -> Genomes:
    """The sums [genomes, values out] of values [genomes, values in], with matrices [values out, values in, genomes]."""
    found = np.zeros((len(values), len(matrix)), np.float32)
    for q in range(len(matrix)):
        for j in range(values.shape[1]):
            for k in range(len(values)):
                found[k, q] += matrix[q, j, k] * values[k, j]
    return found


TERMS = FLOAT32._replace(product=product)  # in which a function computes many genomes side by side


@dataclass(frozen=True, slots=True)
class Contest:
    """A skill and who teaches it, as the mind above says them."""

    skill: Skill
    learner: Learner

    @property
    def size(self) -> tuple[int, int]:
        """The number of inputs and of outputs."""
        return len(self.skill.inputs), self.skill.outputs

    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, weights]."""
        return self.skill.function.draw(*self.size, count, rng)

    def matrices(self, genomes: Genomes) -> Iterator[Genomes]:
        """The matrices [values out, values in, genomes] that genomes [genomes, weights] are."""
        place = 0
        for before, to in self.skill.function.matrix_shapes(*self.size):
            cells = genomes[:, place : (place := place + before * to)]
            yield np.ascontiguousarray(cells.T.reshape(to, before, len(genomes)))


@cache
def contest(says: str, learner: str) -> Contest:
    """The contest of a function and a learner in the words of the language; SystemExit where it does not know them."""
    done = compile_source(Source("poles.mind", MIND.format(says=says, learner=learner)), Path("poles.mind"))
    if done.graph is None:
        raise SystemExit("\n".join(each.message for each in done.diagnostics))
    return Contest(done.graph.skills[0], done.graph.lessons[0].learner)


def balance(
    of: Contest, genomes: Genomes, starts: Doubles, ticks: int, least: int = 1
) -> tuple[NDArray[np.int64], Doubles]:
    """How many ticks [runs] of at most so many both poles are up, and how restless [runs] the last hundred were.

    A run is a genome of [runs, weights] that begins at a start of [runs, 6]. All end where fewer than `least` are left.
    """
    held, restless = np.full(len(genomes), ticks), np.zeros((LAST_TICKS, len(genomes)))
    runs, states, matrices = np.arange(len(genomes)), starts.copy(), [*of.matrices(genomes)]
    memory = np.zeros((len(genomes), of.skill.function.state_length(*of.size)), np.float32)
    ends = np.array([TRACK_M, FALLEN_RADIANS, FALLEN_RADIANS])
    for number in range(ticks):
        readings = (0.5 + 0.5 * states[:, ::2] / ends).astype(np.float32)
        outputs, memory = of.skill.function.forward(TERMS, matrices, readings, memory)
        tick(states, outputs)
        up = (np.abs(states[:, ::2]) <= ends).all(axis=1)
        if not up.all():
            held[runs[~up]] = number
            runs, states, memory = runs[up], states[up], memory[up]
            matrices = [each[..., up] for each in matrices]
            if len(runs) < least:
                held[runs] = number
                break
        restless[number % LAST_TICKS, runs] = np.abs(states[:, :4]).sum(axis=1)
    return held, sum(restless, np.zeros(len(genomes)))  # in this order, however many there are


def scored(of: Contest, genomes: Genomes) -> tuple[Doubles, NDArray[np.int64]]:
    """The damping fitness [genomes] of genomes, and for how many ticks each holds the poles."""
    held, restless = balance(of, genomes, START.repeat(len(genomes), axis=0), SCORED_TICKS)
    calm = np.where(held < LAST_TICKS, 0, 0.75 / np.maximum(restless, 1e-9))
    return 0.1 * held / SCORED_TICKS + 0.9 * calm, held


def other_starts() -> Doubles:
    """The 625 starts [625, 6] of Gruau's test: all pairs of five places, speeds, angles and spins of the long pole."""
    spans = np.array([0.9 * TRACK_M, 1.35, *SPANS])
    four = np.stack(np.meshgrid(*[LATTICE] * 4, indexing="ij"), axis=-1).reshape(-1, 4)
    return np.pad((2 * four - 1) * spans, ((0, 0), (0, 2)))


def starts_held(of: Contest, genome: Genomes) -> int:
    """From how many of the 625 starts a genome [1, weights] holds the poles, if it does so for long from the first.

    0 if it does not; -1 where that was not tried, since there are too few of them.
    """
    starts = other_starts()
    held, _ = balance(of, genome.repeat(len(starts), axis=0), starts, SCORED_TICKS, ENOUGH_STARTS)
    count = int((held == SCORED_TICKS).sum())
    if count < ENOUGH_STARTS:
        return -1
    [long], _ = balance(of, genome, START, LONG_TICKS)
    return count if long == LONG_TICKS else 0


@dataclass(frozen=True, slots=True)
class Trial:
    """One seed of a contest."""

    says: str
    learner: str
    limit: int
    seed: int


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a trial: the evaluations until a genome had solved the task, or all; its starts of 625; its size."""

    solved: bool
    evaluations: int
    starts: int
    neurons: int
    links: int
    fitness: float
    begun: int  # how often the search began
    tests: int
    seconds: float
    weights: list[float]


def tried(trial: Trial) -> Outcome:
    """Search until the task is solved, or the evaluations are spent."""
    of, since = contest(trial.says, trial.learner), time.perf_counter()
    rng, nothing = np.random.default_rng(trial.seed), np.empty((0, of.draw(1, np.random.default_rng(0)).shape[1]))
    population, best, stale = empty_population(nothing.shape[1]), -np.inf, 0
    evaluations = tests = starts = 0
    begun, tested, champion = 1, set[bytes](), nothing
    heredity = Heredity((Part(slice(None), of.skill.function, of.size[1]),))
    while evaluations < trial.limit:
        if 0 < of.learner.patience <= stale:
            population, best, stale, begun = empty_population(nothing.shape[1]), -np.inf, 0, begun + 1
        genomes = ask(population, of.learner, nothing.astype(np.float32), of.draw, rng, heredity)
        scores, held = scored(of, genomes)
        evaluations += len(genomes)
        population = tell(population, of.learner, nothing.astype(np.float32), genomes, scores)
        first = order(scores)[0]
        champion = genomes[first][None]
        best, stale = (scores[first], 0) if scores[first] > best else (best, stale + 1)
        if held[first] == SCORED_TICKS and (key := champion.tobytes()) not in tested:
            tested.add(key)
            tests += 1
            if (starts := starts_held(of, champion)) >= ENOUGH_STARTS:
                break
    return Outcome(
        solved=starts >= ENOUGH_STARTS,
        evaluations=evaluations,
        starts=starts,
        neurons=neurons(of, champion[0]),
        links=int(np.count_nonzero(champion)),
        fitness=float(best),
        begun=begun,
        tests=tests,
        seconds=time.perf_counter() - since,
        weights=champion[0].tolist(),
    )


def neurons(of: Contest, genome: Genomes) -> int:
    """The hidden neurons that a genome uses."""
    function: Any = of.skill.function
    return int(function.pruned(genome, of.size[1]).neurons(*of.size))


def read(log: Path) -> dict[Trial, Outcome]:
    """What stands in a log; a line that was cut short does not count."""
    found = {}
    for line in log.read_text(encoding="utf-8").splitlines() if log.exists() else []:
        if line.endswith("}"):
            both = json.loads(line)
            found[Trial(**both["trial"])] = Outcome(**both["outcome"])
    return found


def told(trial: Trial, outcome: Outcome) -> str:
    """A line on a trial."""
    how = f"{outcome.starts} of 625 starts" if outcome.solved else f"not solved, fitness {outcome.fitness:.3f}"
    return (
        f"seed {trial.seed:3}: {outcome.evaluations:7,} evaluations, {how}, {outcome.neurons} neurons, "
        f"{outcome.links} links, begun {outcome.begun} times, {outcome.tests} tests, {outcome.seconds:.0f} s"
    )


def summary(outcomes: list[Outcome], published: str) -> str:
    """What came of all seeds, in a few lines."""
    solved = [each for each in outcomes if each.solved]
    lines = [f"solved {len(solved)} of {len(outcomes)} seeds"]
    if solved:
        count = [each.evaluations for each in solved]
        lines += [
            f"evaluations of those: mean {mean(count):,.0f}, median {median(count):,.0f}, at most {max(count):,}",
            f"starts {mean(each.starts for each in solved):.0f} of 625, "
            f"neurons {mean(each.neurons for each in solved):.1f}, links {mean(each.links for each in solved):.1f}",
        ]
    return "\n".join([*lines, f"published: {published}"])


def parsed() -> argparse.Namespace:
    """The arguments."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--function", default="elman", choices=SAYS)
    parser.add_argument("--says", default="", metavar="WORDS", help="the function in full")
    parser.add_argument("--learner", default="", metavar="WORDS", help="the learner in full")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first seed, others follow")
    parser.add_argument("--limit", type=int, default=400_000, metavar="EVALUATIONS", help="of a seed")
    parser.add_argument("--workers", type=int, default=cores(), help="seeds at a time")
    parser.add_argument("--log", type=Path, default=Path("runs/double_pole.log"), metavar="FILE")
    parser.add_argument("--json", action="store_true")
    return parser.parse_args()


def main() -> None:
    """Try the seeds that are not in the log, and say what came of all."""
    options = parsed()
    says, learner = options.says or SAYS[options.function], options.learner or LEARNERS[options.function]
    tick(START.copy(), np.zeros((1, 1), np.float32))  # compiled once
    contest(says, learner)
    trials = [Trial(says, learner, options.limit, options.first + i) for i in range(options.seeds)]
    options.log.parent.mkdir(parents=True, exist_ok=True)
    known = read(options.log)
    with ProcessPoolExecutor(options.workers, get_context("spawn")) as pool:
        asked = {pool.submit(tried, trial): trial for trial in trials if trial not in known}
        for done in as_completed(asked):
            trial = asked[done]
            known[trial] = done.result()
            with options.log.open("a", encoding="utf-8") as log:
                log.write(json.dumps({"trial": asdict(trial), "outcome": asdict(known[trial])}) + "\n")
            if not options.json:
                print(told(trial, known[trial]), flush=True)
    outcomes = [known[trial] for trial in trials]
    if options.json:
        print(json.dumps([asdict(each) for each in outcomes]))
    else:
        print(f"{says} by {learner}\n{summary(outcomes, PUBLISHED[options.function])}")


if __name__ == "__main__":
    main()
