"""Findings: what the probes of a task say of its reward lines, each a warning at the line that pays."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores
from mindrun.kinds.registry import phrase
from mindrun.numbers.expression import leaves
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.audit.probes import Evidence, Values
from mindlang.compiler import model
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Counts, of_form
from mindlang.number_format import score as shown

LOOPHOLE_SHARE = 0.1  # of the best score, for nothing that is counted
NEARLY_NOTHING_SHARE = 0.05  # of the best count: as of who runs into something by chance
TRAP_SHARE = 0.1  # of what lies between the median of what moves and the best
FARMED_SHARE, FARMED_ONE_WAY_SHARE = 0.01, 0.0005  # of the best score; of a line that is paid and never taken back
FELT_PAIRS_SHARE, FELT_SHARE, TIE_SHARE = 0.002, 0.01, 1e-5  # of pairs of policies; of the range of all scores
CHAMPION_SHARE = 0.5  # of the most that anybody brings about
SIMPLEST_FIRST = ("still", "moving", "to and fro", "skill", "found", "random")
ROUNDING_DIGITS = 9  # behind the point, of scores that are compared


@dataclass(frozen=True)
class Findings:
    """The evidence of a task held against its lines."""

    of: model.Task
    task: Task
    evidence: Evidence

    def all(self) -> list[Diagnostic]:
        """All findings, in the order of the lines."""
        found = [*self.loopholes(), *self.trap(), *self.farmable(), *self.never(), *self.dominated()]
        return sorted(found, key=lambda each: each.span.start if each.span else 0)

    @cached_property
    def goods(self) -> tuple[int, ...]:
        """The events that a robot is to bring about: what is counted, but for what is punished or ends a run as a
        failure; where nothing of that is counted, and no success can be, what is rewarded.
        """
        ends = {end.event for end in self.task.ends if not end.succeeds and not end.opens}
        paid = {reward.on: amount for reward, amount in zip(self.task.rewards, self._amounts, strict=True)}
        mishaps = {number for number, event in enumerate(self.task.events) if event.is_mishap}
        bad = mishaps | ends | {event for event, amount in paid.items() if event is not None and amount < 0}
        counted = tuple(event for event in self.task.counts if event not in bad)
        if counted or self.task.can_succeed:
            return counted
        return tuple(event for event, amount in paid.items() if event is not None and amount > 0 and event not in bad)

    @property
    def is_counted(self) -> bool:
        """True if anything is counted that a robot is to bring about."""
        return bool(self.goods) or self.task.can_succeed

    @cached_property
    def counts(self) -> Values:
        """How often each policy [policies] has brought about what it should, successes too."""
        return np.asarray(self.evidence.events[:, list(self.goods)].sum(axis=1) + self.evidence.success)

    def counted(self, scores: Scores) -> Values:
        """How often each genome [genomes] has brought about what it should, in the mean of its runs."""
        often = scores.by_event[:, :, list(self.goods)].sum(axis=2) + succeeded(self.task, scores)
        return np.asarray(often.mean(axis=1))

    @property
    def price(self) -> float:
        """The largest score that any policy has for one of what is counted; the best score where nobody counts any."""
        some = self.counts > 0
        return float(max(self.best, 1.0, *(self.evidence.scores[some] / self.counts[some])))

    @cached_property
    def free(self) -> Values:
        """The points [policies] of each policy that are paid for nothing that is counted."""
        return np.asarray(self.evidence.scores - self.evidence.lines[:, self._good_lines].sum(axis=1))

    @cached_property
    def idle(self) -> NDArray[np.bool_]:
        """A mask of the policies that bring about nothing, or nearly nothing, of what is counted."""
        return np.asarray(self.counts <= NEARLY_NOTHING_SHARE * self.counts.max())

    @cached_property
    def best(self) -> float:
        """The best score of any policy; or, where all count nothing, at least what a single event would pay."""
        return float(max([self.evidence.scores.max(), *(self._amounts[line] for line in self._good_lines)]))

    @property
    def champion(self) -> str:
        """The skill that does best, if it brings about at least half as much as anybody; "" where there is none."""
        skills = np.flatnonzero(self.evidence.of("skill") & (self.counts >= CHAMPION_SHARE * self.counts.max()))
        if not len(skills) or not self.counts.max():
            return ""
        return str(self.evidence.origins[skills[self.evidence.scores[skills].argmax()]][0].name)

    @cached_property
    def loophole_rows(self) -> dict[int, int]:
        """For each line with a loophole a policy that is paid most, above all by this line, and counts nothing: of
        those within a tenth of the best score the simplest.
        """
        found = dict[int, int]()
        if self.is_counted and self.best > 0:
            lines = self.evidence.lines.copy()
            lines[:, self._good_lines] = -np.inf
            payer = lines.argmax(axis=1)
            simple = np.array([SIMPLEST_FIRST.index(probe.group) for probe, _ in self.evidence.origins])
            for row in np.lexsort((simple, -np.floor(self.free / (LOOPHOLE_SHARE * self.best)))):
                if self.idle[row] and self.free[row] >= LOOPHOLE_SHARE * self.best and lines[row, payer[row]] > 0:
                    found.setdefault(int(payer[row]), int(row))
        return found

    def loopholes(self) -> Iterator[Diagnostic]:
        """Lines that pay for nothing that is counted."""
        for line, row in self.loophole_rows.items():
            paid = self.evidence.lines[row, line]
            message = (
                f"This pays {shown(paid)} to {self._who(row)}, which {self._does_not()}; "
                f"the best comes to {shown(self.best)}."
            )
            hint = "Pay for what is counted, or for progress toward it, which takes back on the way away what it gave."
            yield self._warning("loophole", self._line(line), message, hint)

    def trap(self) -> Iterator[Diagnostic]:
        """Standing still, where that is worth more than most ways to move."""
        scores, moving = self.evidence.scores, self.evidence.of("moving", "random")
        still = np.flatnonzero(self.evidence.of("still"))
        if not len(still) or not moving.any():
            return
        middle, row = float(np.median(scores[moving])), still[0]
        if scores[row] - middle >= TRAP_SHARE * (max(self.best, scores[row]) - middle) > 0:
            costly = np.median(self.evidence.lines[moving], axis=0) - self.evidence.lines[row]
            share = np.mean(scores[moving] > scores[row])
            message = (
                f"Standing still has {shown(scores[row])}, the median of what moves {shown(middle)}: {share:.0%} of "
                "what moves does better. This makes most of the difference."
            )
            hint = "Punish less, pay less for standing still, or begin with a lesson in which less goes wrong."
            yield self._warning("trap", self._line(int(costly.argmin())), message, hint)

    def farmable(self) -> Iterator[Diagnostic]:
        """Lines per tick that pay who goes to and fro, and counts nothing, more than who stands still."""
        rows, still = np.flatnonzero(self.evidence.of("to and fro")), np.flatnonzero(self.evidence.of("still"))
        if not len(rows) or not len(still) or self.best <= 0 or not self.idle[rows[0]]:
            return
        more = self.evidence.lines[rows[0]] - self.evidence.lines[still[0]]
        for line, reward in enumerate(self.task.rewards):
            gained = min(more[line], self.evidence.lines[rows[0], line], float(more.sum()))
            least = FARMED_ONE_WAY_SHARE if self._is_one_way(line) else FARMED_SHARE
            if reward.on is None and line not in self.loophole_rows and gained >= least * self.best:
                message = f"This pays {shown(more[line], 3)} more to who goes to and fro than to who stands still."
                hint = "Take it back on the way away: progress is advance less retreat."
                yield self._warning("farmable", self._line(line), message, hint)

    def never(self) -> Iterator[Diagnostic]:
        """Lines that paid nobody, and what nobody brought about, though who was taught is among those tried."""
        if not (champion := self.champion):
            return
        who = f"none of {len(self.evidence.scores)} policies, {champion} as it was taught among them"
        for line in np.flatnonzero(~self.evidence.lines.any(axis=0)):
            hint = "Take it out, or pay for something that happens."
            yield self._warning("never-paid", self._line(int(line)), f"This paid {who}.", hint)
        facts = of_form(self.of.facts, Counts)
        for fact, event in zip(facts, self.task.counts, strict=True):
            if event in self.goods and not self.evidence.events[:, event].any():
                message = f"This was brought about by {who}."
                yield self._warning("never-counted", fact.span, message, "Is it possible, and is it what is meant?")

    def dominated(self) -> Iterator[Diagnostic]:
        """Lines without which all policies would stand in the same order, and that are small beside the others."""
        pairs = np.triu_indices(len(self.evidence.scores), 1)

        def order(scores: Values) -> NDArray[np.float64]:
            return np.asarray(np.sign(np.round(scores[pairs[0]] - scores[pairs[1]], ROUNDING_DIGITS)))

        scores = self.evidence.scores
        whole, width = order(scores), float(np.ptp(scores))
        for line, paid in enumerate(self.evidence.lines.T):
            share = float(np.ptp(paid)) / width if width else 0.0
            if not paid.any() or len(self.task.rewards) == 1 or share >= FELT_SHARE or line in self.loophole_rows:
                continue
            if share < TIE_SHARE or np.mean(whole != order(scores - paid)) < FELT_PAIRS_SHARE:
                spreads = np.ptp(self.evidence.lines, axis=0)
                above = int(spreads.argmax())
                message = (
                    f"No policy feels this: it makes a difference of {shown(float(spreads[line]), 3)} at most, where "
                    f"{self.task.rewards[above].text!r} makes one of {shown(float(spreads[above]))}."
                )
                yield self._warning("dominated", self._line(line), message, "Pay more for it, or take it out.")

    @cached_property
    def _amounts(self) -> list[float]:
        """The number that each line pays at a time, where it is one, else 0; of one per tick its sign is not known."""
        amounts = []
        for reward in self.task.rewards:
            match reward.amount:
                case (("number", value),):
                    amounts.append(float(value))
                case (("number", value), ("negate", _)):
                    amounts.append(-float(value))
                case _:
                    amounts.append(0.0)
        return amounts

    def _is_of_success(self, line: int) -> bool:
        """True if a line pays for an event that ends a run as a success."""
        on = self.task.rewards[line].on
        if on is None:
            return False
        ends = (end.event for end in self.task.ends if end.succeeds)
        return on in ends or self.task.events[on].is_of_success

    @cached_property
    def _good_lines(self) -> list[int]:
        """The lines that pay for what is counted, or for a success."""
        rewards = enumerate(self.task.rewards)
        return [line for line, reward in rewards if reward.on in self.goods or self._is_of_success(line)]

    def _is_one_way(self, line: int) -> bool:
        """True if a line pays for an advance that no other line takes back."""
        measured = [leaves(reward.amount, "measure") for reward in self.task.rewards]
        ways = [{self.task.measures[each].way for each in measures} for measures in measured]
        return 1 in ways[line] and not any(-1 in each for each in ways)

    def _who(self, row: int) -> str:
        probe, number = self.evidence.origins[row]
        match probe.group:
            case "still":
                return "who stands still"
            case "moving":
                return f"who always sends {probe.name}"
            case "to and fro":
                return "who goes to and fro"
            case "skill":
                return f"{probe.name} as master"
            case "found":
                return "what the search has found"
        return f"the random genome {number + 1}"

    def _does_not(self) -> str:
        counted = [phrase(self.task.events[event]) for event in self.goods] + ["success"] * self.task.can_succeed
        return f"brings about no {' and no '.join(counted)}"

    def _line(self, line: int) -> Span:
        return self.of.rewards[line].fact.span

    def _warning(self, code: str, span: Span, message: str, hint: str) -> Diagnostic:
        return Diagnostic(code, f"{self.task.name}: {message}", span, hint, severity="warning")
