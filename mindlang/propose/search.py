"""The search for a skill that does a task: probes, candidates, successive halving, growth, and ablation.

A candidate takes the place of a simpler one only where it is surely better: even the middle one of its three attempts
beats the best of the other's by more than two standard errors, on common layouts. A simpler one takes its place where
the best of its attempts is as good.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from mindlang.propose.candidates import BIAS, Candidate, learning_candidates, like_candidates
from mindlang.propose.static import Known
from mindlang.propose.trial import (
    LESSON_GENERATIONS,
    STANDARD_ERRORS,
    Stage,
    Trial,
    gain,
    is_better,
    is_surely_better,
    started,
)

FINAL_ATTEMPTS = 3
WINNER_ATTEMPTS = 6  # of the winner, whose best is shown: of three the best differs by a tenth from that of others
MOST_ADDED = 3  # rounds in which something is added


@dataclass(frozen=True, slots=True)
class Proposal:
    """What came of the search: the winner, what nothing has, and the evidence.

    `probes` have the score of each skill as it is, `tried` that of each candidate where it ended, with the generations
    it had. `worth` is what the winner has by a reading or a subskill, `refused` what it would have by one more, each ±
    its standard error.
    """

    winner: Trial
    nothing: float
    probes: dict[str, float]
    tried: list[tuple[Candidate, int, float]]
    worth: dict[str, tuple[float, float]]
    refused: dict[str, tuple[float, float]]
    ticks: int


@dataclass(slots=True)
class Search:
    """A search at work, and what it has found so far."""

    stage: Stage
    tried: list[tuple[Candidate, int, float]] = field(default_factory=list)
    worth: dict[str, tuple[float, float]] = field(default_factory=dict)
    refused: dict[str, tuple[float, float]] = field(default_factory=dict)
    ticks: int = 0

    @property
    def known(self) -> Known:
        """What is known of the task."""
        return self.stage.known

    def find(self) -> Proposal:
        """The proposal for the task."""
        nothing = self._acting([_nothing(self.known)], "nothing")[0]
        able = [Candidate("unchanged", origin=skill.name) for skill in self.known.mind.skills]
        probes = self._acting(able, "probes")
        probed = {trial.candidate.origin: trial.score for trial in probes}
        names = [*probed]
        likes = self._acting([*like_candidates(self.known, names)], "exchanged readings")
        gains = {name: self._gain_of(nothing, trial) for name, trial in zip(names, probes, strict=True)}
        settled = max([nothing, *probes, *likes], key=lambda trial: trial.score)
        learning = started(self.stage, learning_candidates(self.known, names, gains))
        finalists = self.race(learning)
        if finalists and (settled is nothing or is_surely_better(finalists[0], settled)):
            settled = self.grow(self.prune(finalists[0]), names)
            settled = self._without(settled, [BIAS])
            self._teach(settled, LESSON_GENERATIONS, WINNER_ATTEMPTS)
            self.worth |= {name: cost for name, cost in self._costs(settled).items() if name not in self.worth}
        return Proposal(settled, nothing.score, probed, self.tried, self.worth, self.refused, self.ticks)

    def race(self, trials: Sequence[Trial], finalists: int = 2) -> list[Trial]:
        """Successive halving: all are taught a little, the best go on; the last have three attempts. The best first."""
        running = [*trials]
        for generations, count in ((6, 8), (20, finalists), (LESSON_GENERATIONS, finalists)):
            attempts = FINAL_ATTEMPTS if generations == LESSON_GENERATIONS else 1
            with self.stage.counting(f"{len(running)} candidates, {generations} generations", len(running)) as told:
                for trial in running:
                    self._teach(trial, generations, attempts)
                    told(1)
            running.sort(key=lambda trial: -trial.score)
            self.tried += [(each.candidate, generations, each.score) for each in running[count:]]
            running = running[:count]
        self.tried += [(each.candidate, LESSON_GENERATIONS, each.score) for each in running]
        return running

    def _teach(self, trial: Trial, generations: int, attempts: int) -> None:
        before = trial.ticks
        self.stage.teach(trial, generations, attempts)
        self.ticks += trial.ticks - before

    def grow(self, base: Trial, able: Sequence[str]) -> Trial:
        """The winner with more readings or one more subskill, as long as that is surely better."""
        for _ in range(MOST_ADDED):
            larger = _larger(self.known, base.candidate, able)
            candidates = {what: each for what, each in larger if what not in self.refused}
            found = self.race(started(self.stage, candidates.values()), finalists=1)
            if not found:
                break
            what = next(name for name, each in candidates.items() if each == found[0].candidate)
            self.refused[what] = gain(base.scores[base.best], found[0].scores[found[0].best])
            if not is_surely_better(found[0], base):
                break
            self.worth[what] = self.refused.pop(what)
            base = found[0]
        return base

    def prune(self, base: Trial) -> Trial:
        """The winner without readings that it does not need: if it is as good, all that the task does not name.

        Then those that cost nothing when they are held at their means; where it is worse without all of these, perhaps
        the first half of them.
        """
        unnamed = [name for name in base.candidate.reads if name not in self.known.named and name != BIAS]
        base = self._without(base, unnamed)
        idle = self._idle(base)
        while idle and (smaller := self._without(base, idle)) is base:
            idle = idle[: len(idle) // 2]
        return smaller if idle else base

    def _without(self, base: Trial, names: Sequence[str]) -> Trial:
        """The winner without some readings, taught again; itself where it is better than that."""
        smaller = base.candidate
        for name in names:
            smaller = smaller.without(name)
        if smaller == base.candidate or not smaller.reads:
            return base
        again = self.race(started(self.stage, [smaller]))
        if not again or is_better(base, again[0]):
            return base
        self.refused |= dict.fromkeys(names, gain(again[0].scores[again[0].best], base.scores[base.best]))
        return again[0]

    def _idle(self, base: Trial) -> list[str]:
        """The readings that cost nothing when all of them are held at their means, in the order of `_costs`."""
        means, costs, idle = self.stage.means(base), self._costs(base), list[str]()
        for name in costs:
            if len(idle) + 1 < len(costs):  # one is left
                mean, error = gain(self.stage.holding(base, [*idle, name], means), base.scores[base.best])
                if mean <= STANDARD_ERRORS * error:
                    idle.append(name)
        return idle

    def _costs(self, base: Trial) -> dict[str, tuple[float, float]]:
        """What holding each reading at its mean costs ± its standard error: first of what the task does not name."""
        means = self.stage.means(base)
        with self.stage.counting("each reading held at its mean", len(means)) as told:
            found = dict[str, tuple[float, float]]()
            for name in means:
                if name != BIAS:
                    found[name] = gain(self.stage.holding(base, [name], means), base.scores[base.best])
                told(1)
        return dict(sorted(found.items(), key=lambda item: (item[0] in self.known.named, item[1][0])))

    def _acting(self, candidates: Sequence[Candidate], what: str) -> list[Trial]:
        """Candidates that act without a lesson, scored."""
        found = started(self.stage, candidates)
        with self.stage.counting(what, len(found)) as told:
            for trial in found:
                self.stage.rate(trial)
                self.ticks += trial.ticks
                told(1)
        return found

    def _gain_of(self, nothing: Trial, trial: Trial) -> float:
        """What a skill has more than nothing; 0 where that is within two standard errors."""
        mean, error = gain(nothing.scores[0], trial.scores[0])
        return mean if mean > STANDARD_ERRORS * error else 0.0


def _nothing(known: Known) -> Candidate:
    """A skill that lets every actuator rest."""
    neutral = {part.name: part.kind.neutral for part in known.mind.actuators}
    return Candidate(
        "nothing", (), tuple(f"drives {name} at {neutral[name]:g}" for name in known.actuators), "", "rule"
    )


def _larger(known: Known, candidate: Candidate, able: Sequence[str]) -> Iterator[tuple[str, Candidate]]:
    """What may be added to a candidate, and what it is then: one more reading, or of a master one more subskill."""
    if candidate.way != "master":
        for name in known.changing:
            if name not in candidate.reads:
                yield name, replace(candidate, reads=(*candidate.reads, name))
        return
    learnt = [name for name in candidate.subskills if known.skills[name].function.learns]
    for name in able:
        if name not in learnt and known.skills[name].function.learns:
            more = (read for read in known.reads_of(name) if read in known.named and read not in candidate.reads)
            sends = (f"influences {name}", *candidate.sends)
            yield name, replace(candidate, reads=(*candidate.reads, *more), sends=sends)
    for name in known.changing:
        if name in known.named and name not in candidate.reads:
            yield name, replace(candidate, reads=(*candidate.reads, name))


def propose(stage: Stage) -> Proposal:
    """The proposal for the task of a stage."""
    return Search(stage).find()
