"""Phrases → kinds: the kind found in the registry, its arguments checked and converted."""

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mindrun.kinds.events.event import WITHIN_TICKS, Within
from mindrun.kinds.registry import Argument as Parameter
from mindrun.kinds.registry import arguments, find_kind, kinds, refused_packages
from mindrun.kinds.things.thing import OR, ROBOT, WITHIN, AboutThing
from mindrun.numbers.quantity import COORDINATE, SLOT, THING, Quantity, Reference

from mindlang.compiler.diagnostic import Findings, Label, a, did_you_mean, listed
from mindlang.compiler.families import said
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.maps import text_lines
from mindlang.compiler.resolve.quantities import SHAPES, convert, place_list
from mindlang.compiler.syntax import VERBS, AnyName, Argument, Name, Phrase

LEAST_TICKS = 0.75  # of a time in seconds, which becomes whole ticks
USER_NOUNS = {"content": "thing", "task": "scene"}  # nouns of the registry in the user's words
MISSING_HINTS = {
    "neutral": "It is what the actuator is sent when nothing influences it and whenever something fails: "
    "a wheel's 0 is full reverse. Write neutral 0.5 for a wheel that stands still."
}


@dataclass(frozen=True, slots=True)
class Scope:
    """The names that the arguments of a phrase can use. `things` are None where no task says which there are.

    Text files are in the folder `root`, where that is known, or below it. A declaration is `whole` when all lines below
    it could be read: one that could not be may have had an argument.
    """

    names: Names
    things: Mapping[str, Set[str]] | None
    place: str = "any task"
    whole: bool = True
    root: Path | None = None


def make_kind(noun: str, phrase: Phrase, scope: Scope, findings: Findings) -> Any:
    """The kind that a phrase names, with its arguments, or None after reporting what is wrong with it."""
    cls = find_kind(noun, phrase.kind.text)
    if cls is None:
        message = f"There is no kind of {USER_NOUNS.get(noun, noun)} called {phrase.kind.text}."
        findings.error("unknown-kind", phrase.kind.span, message, _known_kinds(noun, phrase.kind.text, scope))
        return None
    before = len(findings.diagnostics)
    parameters = {parameter.key: parameter for parameter in arguments(cls)}
    values = {
        parameters[key].field: _value(noun, phrase, parameters[key], argument, scope, findings)
        for key, argument in _by_key(phrase.kind.text, phrase.arguments, parameters, findings).items()
    }
    missing = [key for key, parameter in parameters.items() if parameter.required and parameter.field not in values]
    if scope.whole and all(argument.key.text in parameters for argument in phrase.arguments):
        for key in missing:
            kind = phrase.kind.text
            hint = MISSING_HINTS.get(key, f"Add it and its value: {kind} {key} ….")
            findings.error("missing-argument", phrase.span, f"{kind} needs {key}.", hint)
    # a number that is declared wrongly is reported there, and has no value
    has_all = not missing and all(value is not None for value in values.values())
    return cls(**values) if has_all and len(findings.diagnostics) == before else None


def make_event(written: Phrase, scope: Scope, findings: Findings) -> Any:
    """The event of a phrase, or None after reporting what is wrong with it."""
    event = make_kind("event", written, scope, findings)
    if written.within is None:
        return event
    amount, phrase = written.within.amount, written.within.of
    other, is_whole = make_kind("event", phrase, scope, findings), amount.unit == "ticks"
    units = {"s": 1 / (amount.tick_seconds or 1.0), "ticks": 1.0}
    time = Quantity("a time", units, 1.0 if is_whole else LEAST_TICKS, WITHIN_TICKS.high, is_whole)
    ticks = convert(amount, time, findings)
    within, said_ = f"within {amount.span.text}", said(phrase)
    if other and other == event:
        hint = f"Name another event, or leave {within} of {said_} out."
        findings.error("within", phrase.span, f"{said_} is always {within} of itself.", hint)
    elif other and other.is_of_success:
        hint = f"Turn it round: success {within} of what came before."
        findings.error("within", phrase.span, "Nothing comes after a success, which ends the run.", hint)
    elif event and other and ticks:
        return replace(event, within=Within(round(ticks), other))
    return None


def _known_kinds(noun: str, name: str, scope: Scope) -> str:
    """The hint for a kind that a noun does not have."""
    if noun == "content" and name == "door":
        return "A door is a wall that opens: write wall here, and below it opens gate on 2 delivery of key."
    if noun == "skill" and "." in name and (refused := refused_packages()):
        return " ".join(f"{package} has kinds that cannot be used: {why}." for package, why in refused.items())
    if hint := did_you_mean(name, kinds(noun)):
        return hint
    if noun == "skill" and "." in name:
        return "A kind with a dot is brought by a package: install it here. `mindc kinds skill` lists those that are."
    known = f"Known are {listed(sorted(kinds(noun)), 'and')}."
    if noun == "event" and (name in kinds("measure") or scope.names.noun_of(name, ("sensor", "memory"))):
        return f"{name} has a value in every tick: write per tick instead of on. {known}"
    return known


def overrides(cls: type[Any], kind: str, written: Sequence[Argument], findings: Findings) -> dict[str, Any]:
    """The fields that arguments give to an instance of `cls`, all of them numbers."""
    parameters = {parameter.key: parameter for parameter in arguments(cls)}
    found = _by_key(kind, written, parameters, findings)
    return {parameters[key].field: _number(parameters[key], argument, findings) for key, argument in found.items()}


def _by_key(
    kind: str, written: Sequence[Argument], parameters: Mapping[str, Parameter], findings: Findings
) -> dict[str, Argument]:
    for argument in (each for each in written if each.key.text not in parameters):
        _unknown(kind, argument.key, parameters, findings)
    keys = dict.fromkeys(argument.key.text for argument in written)
    return {key: first for key in keys if key in parameters and (first := once(key, written, findings))}


def once(key: str, written: Iterable[Argument], findings: Findings) -> Argument | None:
    """The first argument of a key, None where none is; others are reported."""
    found = [argument for argument in written if argument.key.text == key]
    for again in found[1:]:
        label = Label(found[0].span, "first said here")
        findings.error("repeated-argument", again.key.span, f"{key} is said twice.", "Leave one out.", label)
    return found[0] if found else None


def a_name(argument: Argument, hint: str, findings: Findings) -> Name | None:
    """The name that an argument's value must be; None after reporting that it is none."""
    if isinstance(argument.value, Name):
        return argument.value
    message = f"A number cannot stand after {argument.key.text}."
    if isinstance(argument.value, AnyName):
        message = f"Only one name can stand after {argument.key.text}."
    findings.error("not-a-name", argument.value.span, message, hint)
    return None


def _unknown(kind: str, key: Name, parameters: Mapping[str, Parameter], findings: Findings) -> None:
    if key.text in VERBS:
        findings.error("two-facts", key.span, "Two facts stand on one line.", f"Begin a new line before {key.text}.")
        return
    named = [each for each, parameter in parameters.items() if each != kind and parameter.type != SLOT]
    takes = f"{kind} takes {listed(named, 'and')}." if named else f"{kind} takes no arguments."
    hint = did_you_mean(key.text, parameters) or takes
    findings.error("unknown-argument", key.span, f"{kind} has no argument called {key.text}.", hint)


def _value(
    noun: str, phrase: Phrase, parameter: Parameter, argument: Argument, scope: Scope, findings: Findings
) -> Any:
    if parameter.shape == "lines":
        return text_lines(argument.value, scope.root, findings)
    if parameter.shape == "region" and not isinstance(argument.value, Name):
        corners = place_list(argument.value, COORDINATE, findings)
        return corners and tuple(zip(*(sorted(along) for along in zip(*corners, strict=True)), strict=True))
    if not isinstance(parameter.type, Reference):
        return _number(parameter, argument, findings)
    if isinstance(argument.value, AnyName) and noun == "sensor" and parameter.type == THING:
        return _things(argument.value.names, phrase.kind.text, parameter.key, scope, findings)
    name = a_name(argument, f"Here stands the name of a {parameter.type.noun}.", findings)
    if name is None:
        return None
    match parameter.type.noun:
        case "thing":
            _check_thing(name, noun, phrase.kind.text, parameter.key, scope, findings)
        case "sensor":
            scope.names.find(name, ("sensor", "memory"), findings)
        case "skill":
            scope.names.find(name, ("skill",), findings)
        case "servo":
            _check_servo(name, scope.names, findings)
        case "environment" | "name of a part of an observation or an action":
            pass  # what there is, nobody but the environment knows: `resolve.outside` asks it
        case "Python function":
            if "." not in name.text:
                hint = f"Write the module and the function: procedure from module.{name.text}."
                findings.error("no-module", name.span, f"{name.text} does not say in which module it is.", hint)
        case noun_ if name.text not in (known := parameter.type.words):
            hint = did_you_mean(name.text, known) or f"It is {listed(known)}."
            findings.error(f"unknown-{noun_}", name.span, f"There is no {noun_} called {name.text}.", hint)
    return name.text


def _things(names: Sequence[Name], kind: str, key: str, scope: Scope, findings: Findings) -> str:
    """The things that a sensor is about alike, each said once."""
    for place, name in enumerate(names):
        if name.text in {each.text for each in names[:place]}:
            findings.error("repeated-argument", name.span, f"{name.text} is said twice.", "Leave one out.")
        else:
            _check_thing(name, "sensor", kind, key, scope, findings)
    return OR.join(name.text for name in names)


def _check_servo(name: Name, names: Names, findings: Findings) -> None:
    """Report a name that is no actuator's, or that of one on which no sensor can sit."""
    if not names.find(name, ("actuator",), findings):
        return
    phrase = names.table["actuator"][name.text].header.phrase
    cls = find_kind("actuator", phrase.kind.text) if phrase else None
    if phrase and cls and not cls.carries:
        hint = f"Declare actuator {name.text} is servo, or name a servo."
        findings.error("no-servo", name.span, f"{name.text} is {a(phrase.kind.text)}: nothing turns with it.", hint)


def _number(parameter: Parameter, argument: Argument, findings: Findings) -> Any:
    assert isinstance(parameter.type, Quantity)
    return SHAPES[parameter.shape](argument.value, parameter.type, findings)


def about(noun: str, kind: str, argument: str = "of") -> Set[str]:
    """The kinds of things that an argument of a kind can name."""
    cls = find_kind(noun, kind) or AboutThing
    return {name for name, thing in kinds("content").items() if cls.accepts(argument, thing)}


def _is_place(name: Name, cls: Any, scope: Scope, findings: Findings) -> bool:
    """True if a name is that of a memory: a place hides a thing of its name where the kind can be about either.

    A memory that the kind cannot be about is reported, where there is no such thing.
    """
    is_memory = scope.names.noun_of(name.text, ("memory",)) is not None
    found = scope.names.kind_of_memory(name.text)
    if found is None or (found.is_place and cls.can_be_reckoned):
        return is_memory
    if name.text in (scope.things or ()):
        return False
    of = listed(kind for kind, each in kinds("sensor").items() if each.can_be_reckoned)
    hint = f"Of a memory that is a place there is {of}; a task contains what else a sensor is about."
    findings.error("unfit-thing", name.span, f"{name.text} is a memory, and no thing of a task.", hint)
    return True


def _check_thing(name: Name, noun: str, kind: str, key: str, scope: Scope, findings: Findings) -> None:
    cls = find_kind(noun, kind) or AboutThing
    if scope.things is None or (noun == "sensor" and _is_place(name, cls, scope, findings)):
        return
    if noun == "content" and key != WITHIN and name.text == ROBOT:
        if ROBOT in scope.things:
            hint = "Give the thing another name."
            findings.error("unfit-thing", name.span, f"{key} robot means the robot, and no thing of that name.", hint)
        return
    if name.text not in scope.things:
        add = f"Add contains {name.text} is {listed(sorted(about(noun, kind, key)))} to the task."
        hint = findings.suggest(name.text, scope.things) or add
        findings.error("unknown-thing", name.span, f"There is nothing called {name.text} in {scope.place}.", hint)
        return
    there = [find_kind("content", each) for each in scope.things[name.text]]
    if all(there) and not any(cls.accepts(key, thing) for thing in there if thing):
        is_ = listed(a(kind) for kind in sorted(scope.things[name.text]))
        about_ = WITHIN if key == WITHIN else "about"
        hint = f"{name.text} is {is_}; {kind} is {about_} {listed(a(each) for each in sorted(about(noun, kind, key)))}."
        findings.error("unfit-thing", name.span, f"{kind} cannot be {about_} {name.text}.", hint)
