"""Goals: what a task wants, avoids and keeps, written out as rewards, ends and counts.

Of N goals each is worth 100 / N, and as much of it as it is met: the share of the events that it wants, of the ticks in
which it was kept or not yet failed, of the time for which it was to be kept. One point more is for being near to what
is wanted. A run in which all are met is a success.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from dataclasses import replace as with_fields
from functools import cached_property
from typing import Any

from mindrun.numbers.quantity import Quantity
from msgspec.structs import replace

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.families import said
from mindlang.compiler.names import Names
from mindlang.compiler.parse.shape import parse_line
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Declaration, Fact, Goal, Phrase, of_form, rebuilt

POINTS = 100  # of all goals that are met
NEAR_UNITS = 25  # how far from what it wants a robot has half of what being near is worth
MAX_RUN_TICKS = 10_000_000
TIMES = Quantity("how many times", {"": 1.0}, low=1, high=MAX_RUN_TICKS, whole=True)
INSTEAD = syntax.Rewards, syntax.Succeeds  # what a task with goals does not say

Line = tuple[str, Goal]  # a line of a task, and the goal that it is for
Convert = Callable[[syntax.Amount, Quantity, Findings], Any]


def with_goals(
    names: Names, writer: Callable[[Any], Any], tick: float, convert: Convert, findings: Findings
) -> Names:
    """The declarations with the goals of each task written out behind its lines; `writer` fills in named numbers."""
    found = {}
    for name, task in names.declarations("task"):
        with findings.each_once():
            goals = Goals.of(task, tick, convert, findings)
        lines = [_fact(line, goal, writer) for line, goal in goals.lines()] if goals else []
        found[name] = replace(task, facts=(*task.facts, *lines))
    return with_fields(names, table=names.table | {"task": found}) if found else names


def _fact(text: str, goal: Goal, writer: Callable[[Any], Any]) -> Fact:
    """The fact of a line, its places those of the same words in the goal's line, or else that whole line."""
    at, own = goal.span, goal.span.text

    def placed(node: Any) -> Any:
        if not isinstance(node, Span):
            return node
        start = own.find(node.text)
        return Span(at.source, at.start + start, at.start + start + len(node.text)) if start >= 0 else at

    fact: Fact = writer(rebuilt(parse_line(text, Source(at.source.name, text), 0, "line"), placed))
    near = isinstance(fact, syntax.Rewards) and isinstance(goal, syntax.Wants) and NEAR in text
    return replace(fact, span=goal.event.span) if near else fact


NEAR = "(greatest of "  # begins what is paid for being near


@dataclass(frozen=True)
class Goals:
    """The goals of a task that lasts so many ticks, each with how often or for how many ticks, and until when.

    `zone` is the first zone that the task contains.
    """

    goals: Sequence[tuple[Goal, int, int]]
    ticks: int
    zone: str

    @classmethod
    def of(cls, task: Declaration, tick: float, convert: Convert, findings: Findings) -> "Goals | None":
        """The goals of a task; None where it has none, or where what is wrong has been reported, or will be."""
        goals = of_form(task.facts, Goal)  # type: ignore[arg-type]
        if not goals or _both(task, goals[0], findings):
            return None
        time = Quantity("a time", {"s": 1 / tick, "ticks": 1.0}, 1.0, MAX_RUN_TICKS)
        lasts = of_form(task.facts, syntax.Lasts)
        ticks = convert(lasts[0].amount, time, Findings()) if lasts else None
        if not ticks:
            return None

        def numbers(goal: Goal) -> tuple[int, int] | None:
            """How often, or for how long, and until or from when; None after reporting a time that does not fit."""
            times, limit = getattr(goal, "times", None), getattr(goal, "deadline", None) or getattr(goal, "time", None)
            count = convert(times, TIMES, findings) if times else 1
            until = convert(limit.amount, time, findings) if limit else 0
            if count is None or until is None:
                return None
            if round(until) >= round(ticks) and limit:
                message = f"The run lasts no longer than that: {said(lasts[0].amount)}."
                findings.error("late-goal", limit.span, message, "Write a shorter time, or let it last longer.")
                return None
            return int(count), round(until)

        found = [(goal, numbers(goal)) for goal in goals]
        whole = [(goal, *each) for goal, each in found if each]
        contained = of_form(task.facts, syntax.Contains)
        zones = [fact.name.text for fact in contained if fact.phrase.kind.text == "zone"]
        return cls(whole, round(ticks), (*zones, "")[0]) if len(whole) == len(goals) else None

    def lines(self) -> Iterator[Line]:
        """The lines that mean what the goals mean: what ends, what succeeds, what is rewarded and what is counted."""
        for goal, times, _ in self.goals:
            match goal:
                case syntax.Avoids(event=event) if event:
                    yield f"ends on {f'{times} ' * (times > 1)}{said(event)}", goal
                case syntax.Avoids(when=when):
                    yield f"ends when {_condition(when)}", goal
        yield f"succeeds when {' and '.join(self._met())}", self.goals[0][0]
        for goal, times, time in self.goals:
            yield f"rewards {self._points} * {self._share(goal, times, time)} at the end{self._while(goal, times)}", goal
        near = [(goal, times, self._near(goal)) for goal, times, _ in self.goals]
        nears = [each for each in near if each[2]]
        for goal, times, close in nears:
            over = f" / {len(nears)}" if len(nears) > 1 else ""
            met = f"least of 1 ({self._counted(goal)} - {times - 1})" if times > 1 else f"least of 1 {self._counted(goal)}"
            yield f"rewards {NEAR}({close}) ({met})){over} at the end", goal
        for goal, *_ in self.goals:
            if isinstance(goal, syntax.Wants):
                yield f"counts {said(goal.event)}", goal

    @property
    def _points(self) -> str:
        return f"{POINTS} / {len(self.goals)}" if len(self.goals) > 1 else f"{POINTS}"

    @cached_property
    def _limits(self) -> Mapping[int, int]:
        """The time of each goal, by its identity; 0 for none."""
        return {id(goal): time for goal, _, time in self.goals}

    def _counted(self, goal: Goal) -> str:
        """What is counted of a goal: the events that it wants or avoids, or the ticks of its condition."""
        time = self._limits[id(goal)]
        match goal:
            case syntax.Wants(event=event):
                return f"(count of {said(event)}{f' when time <= {time}' * bool(time)})"
            case syntax.Avoids(event=event) if event:
                return f"(count of {said(event)})"
            case syntax.Keeps(time=syntax.Lasting()):
                return f"(longest when {_condition(goal.when)})"
        after = f"time > {time}" if time else ""
        return f"(count when {_condition(goal.when, after)})"

    def _share(self, goal: Goal, times: int, time: int) -> str:
        """How much of a goal is met, in 0 to 1."""
        counted = self._counted(goal)
        match goal:
            case syntax.Wants() if times == 1:
                return f"(least of 1 {counted})"
            case syntax.Wants():
                return f"(least of {counted} {times}) / {times}"
            case syntax.Avoids():
                return f"time / {self.ticks}"
            case syntax.Keeps(time=syntax.Lasting()):
                return f"(least of {counted} {time}) / {time}"
        return f"{counted} / {self.ticks - time}"

    def _while(self, goal: Goal, times: int) -> str:
        return f" when {self._counted(goal)} < {times}" if isinstance(goal, syntax.Avoids) else ""

    def _met(self) -> Iterator[str]:
        """The conditions that all hold once every goal is met; what is avoided has ended the run before."""
        goes_on = False
        for goal, times, time in self.goals:
            match goal:
                case syntax.Wants():
                    yield f"{self._counted(goal)} >= {times}"
                case syntax.Keeps(time=syntax.Lasting()):
                    yield f"{self._counted(goal)} >= {time}"
                case syntax.Keeps():
                    yield f"{self._counted(goal)} >= {self.ticks - time}"
                    goes_on = True
                case syntax.Avoids():
                    yield f"{self._counted(goal)} < {times}"
                    goes_on = True
        if goes_on:
            yield f"time >= {self.ticks}"

    def _near(self, goal: Goal) -> str:
        """How near the robot is to what a goal wants, in 0 to 1; of a delivery also that to the zone; "" for nothing."""
        if not isinstance(goal, syntax.Wants):
            return ""
        named = {each.key.text: each.value.text for each in goal.event.arguments if isinstance(each.value, syntax.Name)}
        thing, kind = named.get("of", ""), goal.event.kind.text
        match kind:
            case "reach":
                return _closeness(thing, named.get("by", ""))
            case "delivery":
                zone = named.get("to", self.zone)
                return f"({_closeness(thing)} + {_closeness(zone, thing)}) / 2"
        return ""


def _closeness(thing: str, of: str = "") -> str:
    """1 where the robot, or another thing, is at a thing; half of it `NEAR_UNITS` away."""
    return f"{NEAR_UNITS} / ({NEAR_UNITS} + (distance{f' of {of}' * bool(of)} to {thing}))"


def _condition(when: syntax.When, also: str = "") -> str:
    """The text of a condition, each of its alternatives together with another comparison, if any."""
    return " or ".join(
        " and ".join([*(said(each) for each in all_), *([also] if also else [])]) for all_ in when.alternatives
    )


def _both(task: Declaration, goal: Goal, findings: Findings) -> bool:
    """True after reporting that a task has goals and says its rewards, or its success, as well."""
    more = [fact for fact in task.facts if isinstance(fact, INSTEAD)]
    name = task.header.name.text
    for fact in more:
        hint = f"Leave it out, or write what the goals reward: {goal.span.source.edit('rewards', name)}."
        message = f"{name} has goals, which say themselves what is rewarded and what is a success."
        findings.error("goals-and-rewards", fact.span, message, hint, Label(goal.span, "a goal"))
    return bool(more)
