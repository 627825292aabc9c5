"""What differs from run to run of a task: arguments that vary, actuators that fail."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from mindrun.kinds.registry import arguments, names
from mindrun.kinds.variation import VARIED_NOUNS, Failure, Variation, Varying, varied_quantity
from mindrun.numbers.quantity import RATE, Quantity

from mindlang.compiler.diagnostic import Findings, did_you_mean, listed
from mindlang.compiler.model import Part
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.parts import refuse_repeated
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Fails, Name, Varies

F = TypeVar("F", Varies, Fails)

NAMES = "Name the body, an actuator, a sensor or a thing of the task."


@dataclass(frozen=True, slots=True)
class Variable:
    """What can differ from run to run, by noun: the parts of the robot, and the things of the world."""

    names: Names
    parts: Mapping[str, Sequence[Part[Any]]]
    place: str

    def find(self, name: Name, findings: Findings) -> tuple[Varying, Any] | None:
        """What a name is of, and its kind; None after reporting that there is nothing of it, or where that is wrong."""
        noun: Varying = self.names.noun_of(name.text, VARIED_NOUNS) or "thing"
        if found := [part for part in self.parts[noun] if part.name == name.text]:
            return (noun, found[0].kind) if found[0].kind else None
        if self.names.noun_of(name.text, ("memory",)):
            findings.error("cannot-vary", name.span, "A memory is the same in every run.", NAMES)
        elif noun == "thing" and name.text not in self.names.unread:
            known = [*self.names.of(*VARIED_NOUNS), *(thing.name for thing in self.parts["thing"])]
            hint = findings.suggest(name.text, known) or NAMES
            message = f"There is no part of the robot and nothing in {self.place} called {name.text}."
            findings.error("unknown-part", name.span, message, hint)
        return None


def variations(declaration: Declaration, variable: Variable, findings: Findings) -> tuple[Variation, ...]:
    """What a task or a scene says that varies, without the lines that are reported."""
    facts = {
        fact: f"how {fact.argument.text} of {fact.of.text} varies"
        for fact in declaration.facts
        if isinstance(fact, Varies)
    }
    found = (_variation(fact, variable, findings) for fact in _once(facts, findings))
    return tuple(each for each in found if each)


def failures(declaration: Declaration, variable: Variable, findings: Findings) -> tuple[Failure, ...]:
    """What a task or a scene says that fails, without the lines that are reported."""
    facts = {fact: f"how {fact.name.text} fails" for fact in declaration.facts if isinstance(fact, Fails)}
    found = []
    for fact in _once(facts, findings):
        actuator, rate = variable.names.find(fact.name, ("actuator",), findings), convert(fact.rate, RATE, findings)
        if actuator and rate is not None:
            found.append(Failure(fact.name.text, rate))
    return tuple(found)


def _variation(fact: Varies, variable: Variable, findings: Findings) -> Variation | None:
    of = variable.find(fact.of, findings)
    if of is None:
        return None
    noun, kind = of
    known = {each.key: each.field for each in arguments(type(kind))}
    field = known.get(fact.argument.text)
    quantity = varied_quantity(kind, field) if field else None
    if field is None or quantity is None:
        _refuse(
            fact, names()[type(kind)], known, [key for key, each in known.items() if each in kind.varying], findings
        )
        return None
    range_ = _range(fact, quantity, findings)
    return Variation(noun, "" if noun == "body" else fact.of.text, field, *range_) if range_ else None


def _refuse(fact: Varies, kind: str, known: Mapping[str, str], varying: Sequence[str], findings: Findings) -> None:
    key = fact.argument
    can = f"Of {fact.of.text} can vary {listed(varying)}." if varying else f"Nothing of {fact.of.text} can vary."
    if key.text in known:
        message = f"{key.text} of {fact.of.text} is the same in every run."
        findings.error("cannot-vary", key.span, message, can)
    else:
        hint = did_you_mean(key.text, varying) or can
        findings.error("unknown-argument", key.span, f"{kind} has no argument called {key.text}.", hint)


def _range(fact: Varies, quantity: Quantity, findings: Findings) -> tuple[float, float] | None:
    high = convert(fact.high, quantity, findings)
    low = None if high is None else convert(fact.low, quantity, findings, fact.high.unit)
    if low is None or high is None:
        return None
    if low > high:
        where = Span(fact.span.source, fact.low.span.start, fact.high.span.end)
        message = "This range ends below its beginning."
        findings.error("range-backwards", where, message, "Write the smaller number first.")
        return None
    return float(low), float(high)


def _once(facts: Mapping[F, str], findings: Findings) -> Iterator[F]:
    """The facts, each of which says something, without those that say again what one before has said."""
    by_meaning: dict[str, list[F]] = {}
    for fact, says in facts.items():
        by_meaning.setdefault(says, []).append(fact)
    for says, same in by_meaning.items():
        refuse_repeated(same, f"The task already says {says}.", "Leave one out.", findings)
        yield same[0]
