"""Goals: what a task wants, avoids and keeps, written out as ends, rewards at the end, and counts.

Of N goals each is worth 100 / N points, and as much of it as it is met. What is preferred is worth 10 points together,
and to be near to what is wanted one more.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from dataclasses import replace as with_fields
from typing import Any

from mindrun.numbers.quantity import Quantity
from msgspec.structs import replace

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.families import said
from mindlang.compiler.names import Names
from mindlang.compiler.parse.shape import parse_line
from mindlang.compiler.resolve.quantities import MAX_RUN_TICKS, TIMES, convert
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Declaration, Fact, Goal, of_form, rebuilt

GOAL_POINTS, PREFERENCE_POINTS = 100.0, 10.0  # of all that are met; being near is worth 1
NEAR_UNITS = 25  # how far from what it wants a robot has half of what being near is worth
NEAR = "rewards (greatest of "  # begins the line of what is paid for being near
INSTEAD = syntax.Rewards, syntax.Succeeds  # what a task with goals does not say

Line = tuple[str, Any]  # a line of a task, and the goal that it is for


def with_goals(names: Names, write: Callable[[Any], Any], tick_seconds: float, findings: Findings) -> Names:
    """The declarations with the goals of each task written out; `write` puts numbers where a line names them."""
    found = {}
    for name, task in names.declarations("task"):
        with findings.each_once():
            lines = goal_lines(task, names, tick_seconds, findings)
        found[name] = replace(task, facts=(*task.facts, *(_fact(*line, write) for line in lines)))
    return with_fields(names, table=names.table | {"task": found}) if found else names


def _fact(text: str, goal: Any, write: Callable[[Any], Any]) -> Fact:
    """The fact of a line, in the place of the goal's line, and what both say in the place that it has there."""
    at, own = goal.span, goal.span.text

    def placed(node: Any) -> Any:
        if not isinstance(node, Span):
            return node
        start = own.find(node.text)
        return Span(at.source, at.start + start, at.start + start + len(node.text)) if start >= 0 else node

    fact: Fact = write(rebuilt(parse_line(text, Source(at.source.name, text), 0, "line"), placed))
    whole = {field: replace(of, span=at) for field in ("when", "amount") if (of := getattr(fact, field, None))}
    return replace(fact, **whole, span=goal.event.span if text.startswith(NEAR) else at)


def goal_lines(task: Declaration, names: Names, tick_seconds: float, findings: Findings) -> list[Line]:
    """The lines that mean what the goals of a task mean; none where it has none, or what is wrong is reported."""
    written: list[Any] = [fact for fact in task.facts if isinstance(fact, Goal)]
    preferred = of_form(task.facts, syntax.Prefers)
    lasts = of_form(task.facts, syntax.Lasts)
    if not (written or preferred) or _refused(task, written or preferred, names, findings) or not lasts:
        return []
    time = Quantity("a time", {"s": 1 / tick_seconds, "ticks": 1.0}, 1.0, MAX_RUN_TICKS)
    ticks = round(convert(lasts[0].amount, time, Findings()) or 0)
    zones = [fact.name.text for fact in of_form(task.facts, syntax.Contains) if fact.phrase.kind.text == "zone"]
    goals: list[_Goal] = []
    before, now = "", list[str]()  # what has to be met before the goals that come now, and these
    for fact in written:
        if fact.then:
            before, now = " and ".join(now), []
        times = convert(fact.times, TIMES, findings) if fact.times else 1
        limit = convert(fact.time.amount, time, findings) if fact.time else 0
        if times is None or limit is None or not ticks:
            return []
        if fact.time and round(limit) >= ticks:
            message = f"A run is over by then: it {said(lasts[0])}."
            findings.error("late-goal", fact.time.span, message, "Write a shorter time, or let it last longer.")
            return []
        goals.append(_Goal(fact, int(times), round(limit), ticks, before, (*zones, "")[0]))
        now += [] if goals[-1].lasts else [goals[-1].met]
    return [*_lines(goals, preferred, ticks, " and ".join(now))]


def _refused(task: Declaration, goals: Sequence[Any], names: Names, findings: Findings) -> bool:
    """True after reporting that a task has goals, and something beside that they cannot be with."""
    before, first, name = len(findings.diagnostics), goals[0], task.header.name.text
    for fact in (fact for fact in task.facts if isinstance(fact, INSTEAD)):
        hint = f"Leave it out. Then {first.span.source.edit('rewards', name)} writes out what the goals reward."
        message = f"{name} has goals, which say what is rewarded, and what is a success."
        findings.error("goals-and-rewards", fact.span, message, hint, Label(first.span, "a goal"))
    is_later = False
    for fact in goals:
        is_later |= getattr(fact, "then", False)
        if is_later and isinstance(fact, syntax.Avoids | syntax.Keeps) and not _is_lasting(fact):
            hint = "Write it above the line that begins with then; or keep it for a time: for 5 s."
            findings.error("goal-order", fact.span, "This is so from the beginning, and comes after nothing.", hint)
    if isinstance(first, syntax.Prefers):
        hint = "Say what is wanted, avoided or kept, as wants 10 reach of ball; then what is preferred."
        findings.error("no-goal", first.span, f"{name} prefers something, and wants nothing.", hint)
    elif first.then:
        findings.error("goal-order", first.span, "Before the first goal there is none.", "Leave then out.")
    if noun := names.noun_of("time", ("sensor", "memory", "actuator", "number")):
        hint = "Call it otherwise, as time_left."
        place = names.place_of(noun, "time")
        findings.error("goal-time", place, "Goals are about the time of a run, which this hides.", hint)
    return len(findings.diagnostics) > before


def _is_lasting(fact: Any) -> bool:
    return isinstance(fact, syntax.Keeps) and isinstance(fact.time, syntax.Lasting)


@dataclass(frozen=True, slots=True)
class _Goal:
    """A goal as pieces of lines: how many `times`, and the time that it says, in a task of so many ticks.

    It counts from the tick after that in which what is `before` it holds. `zone` is where things are delivered.
    """

    fact: Any
    times: int
    time: int
    ticks: int
    before: str
    zone: str

    @property
    def lasts(self) -> bool:
        """True if only a whole run shows that it is met."""
        return not isinstance(self.fact, syntax.Wants) and not _is_lasting(self.fact)

    @property
    def counted(self) -> str:
        """What is counted: the events that it is about, or the ticks in which its condition holds."""
        clock, bound = "time", self.time
        if self.before:
            clock, bound = f"(count when {self.before})", self.time + 1
        since = [f"{clock} > 1"] if self.before else []
        match self.fact:
            case syntax.Keeps(when) if _is_lasting(self.fact):
                return f"(longest when {_condition(when, *since)})"
            case syntax.Keeps(when):
                return f"(count when {_condition(when, *([f'time > {self.time}'] if self.time else []))})"
            case syntax.Avoids(when=when) if when:
                return f"(count when {_condition(when)})"
        until = [f"{clock} <= {bound}"] if self.time else []
        return f"(count of {said(self.fact.event)}{' when ' * bool(since or until)}{' and '.join([*since, *until])})"

    @property
    def needed(self) -> int:
        """The count with which it is met."""
        if isinstance(self.fact, syntax.Keeps):
            return self.time if _is_lasting(self.fact) else self.ticks - self.time
        return self.times

    @property
    def met(self) -> str:
        """The condition that it is met."""
        return f"{self.counted} {'<' if isinstance(self.fact, syntax.Avoids) else '>='} {self.needed}"

    @property
    def share(self) -> str:
        """How much of it is met, 0 to 1."""
        if isinstance(self.fact, syntax.Avoids):
            return f"time / {self.ticks}"
        return f"(least of {self.counted} {self.needed})" + (f" / {self.needed}" if self.needed > 1 else "")

    @property
    def end(self) -> str:
        """The line that ends a run as a failure; empty for none."""
        if not isinstance(self.fact, syntax.Avoids):
            return ""
        if self.fact.when:
            return f"ends when {_condition(self.fact.when)}"
        return f"ends on {f'{self.times} ' * (self.times > 1)}{said(self.fact.event)}"

    @property
    def near(self) -> str:
        """How near the robot is to what it wants, 0 to 1, from when it counts; 1 once it is met; empty for nothing."""
        if not isinstance(self.fact, syntax.Wants):
            return ""
        event = self.fact.event
        named = {each.key.text: each.value.text for each in event.arguments if isinstance(each.value, syntax.Name)}
        thing = named.get("of", "")
        match event.kind.text:
            case "reach":
                near = _closeness(thing, named.get("by", ""))
            case "delivery":
                near = f"({_closeness(thing)} + {_closeness(named.get('to', self.zone), thing)}) / 2"
            case _:
                return ""
        if self.before:
            near = f"(least of 1 (count when {self.before})) * {near}"
        met = f"({self.counted} - {self.needed - 1})" if self.needed > 1 else self.counted
        return f"{NEAR}({near}) (least of 1 {met}))"


def _closeness(thing: str, of: str = "") -> str:
    """1 where the robot, or another thing, is at a thing; half of it `NEAR_UNITS` away."""
    return f"{NEAR_UNITS} / ({NEAR_UNITS} + (distance{f' of {of}' * bool(of)} to {thing}))"


def _condition(when: syntax.When, *also: str) -> str:
    """The text of a condition, each of its alternatives together with other comparisons."""
    return " or ".join(" and ".join([*map(said, all_), *also]) for all_ in when.alternatives)


def _lines(goals: Sequence[_Goal], preferred: Sequence[syntax.Prefers], ticks: int, done: str) -> Iterator[Line]:
    """What ends a run, what is a success, and what is rewarded and counted.

    All that needs no whole run is met once what is `done` holds.
    """
    first = goals[0].fact
    yield from ((goal.end, goal.fact) for goal in goals if goal.end)
    whole = [f"time >= {ticks}"] if preferred or any(goal.lasts for goal in goals) else []
    lasting = (goal.met for goal in goals if goal.lasts)
    yield f"succeeds when {' and '.join([*([done] if done else []), *lasting, *whole])}", first
    for goal in goals:
        while_ = f" when {goal.met}" if goal.end else ""
        yield f"rewards {_share_of(GOAL_POINTS, len(goals))} * {goal.share} at the end{while_}", goal.fact
    for fact in preferred:
        how, amount = fact.how.text, fact.amount
        much = f"1 / (1 + (greatest of 0 (sum of {said(amount)})) / {ticks})" if amount else ""
        soon = f"(count when {done or f'time >= {ticks}'}) / {ticks}"
        share = {"soon": soon, "little": much, "much": f"(1 - {much})"}[how]
        yield f"rewards {_share_of(PREFERENCE_POINTS, len(preferred))} * {share} at the end", fact
    near = [(goal.near, goal.fact) for goal in goals if goal.near]
    for line, fact in near:
        yield f"{line}{f' / {len(near)}' * (len(near) > 1)} at the end", fact
    yield from ((f"counts {said(goal.fact.event)}", goal.fact) for goal in goals if isinstance(goal.fact, syntax.Wants))


def _share_of(points: float, count: int) -> str:
    return f"{points:g} / {count}" if count > 1 else f"{points:g}"
