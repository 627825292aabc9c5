"""What is different in meaning between two minds; how it is written is not."""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any

from mindlang.model import Mind
from mindlang.source import Span
from mindlang.syntax import NOUNS, Amount, Declaration, Phrase

SHARE = 0.01  # what % means


@dataclass(frozen=True, slots=True)
class Difference:
    """A declaration or a setting that is new, gone, or changed: lines of it that are new and that are gone, as written.

    A declaration that is itself new or gone has its header among them.
    """

    what: str
    gone: tuple[str, ...]
    new: tuple[str, ...]


def differences(old: Mind, new: Mind) -> list[Difference]:
    """What changes from one mind to another, noun by noun; nothing for the order of lines, comments and other spellings."""
    found = [*_settings(old, new)]
    for noun in NOUNS:
        before, after = _declared(old, noun), _declared(new, noun)
        for name in dict.fromkeys((*before, *after)):
            found += _declaration(f"{noun} {name}", before.get(name), after.get(name), _same_kind(noun, name, old, new))
    return found


def _settings(old: Mind, new: Mind) -> Iterator[Difference]:
    if old.master != new.master:
        yield Difference("master", (f"master {old.master}",), (f"master {new.master}",))
    if old.tick != new.tick:
        yield Difference("tick", (f"tick {old.tick:.6g} s",), (f"tick {new.tick:.6g} s",))


def _declared(mind: Mind, noun: str) -> dict[str, Declaration]:
    declarations = (declaration for file in mind.files for declaration in file.declarations)
    return {each.header.name.text: each for each in declarations if each.header.noun.text == noun}


def _same_kind(noun: str, name: str, old: Mind, new: Mind) -> bool:
    """Whether two headers say the same though they are written otherwise: a default may be said or not."""
    return noun not in ("curriculum",) and _kind(old, noun, name) == _kind(new, noun, name)


def _kind(mind: Mind, noun: str, name: str) -> Any:
    match noun:
        case "skill":
            return next((skill.function for skill in mind.skills if skill.name == name), None)
        case "task":
            return next((task.scene for task in mind.tasks if task.name == name), None)
    parts = {"sensor": mind.sensors, "memory": mind.memories, "actuator": mind.actuators, "body": (mind.body,)}
    return next((part.kind for part in parts[noun] if part.name == name), None)


def _declaration(
    what: str, before: Declaration | None, after: Declaration | None, same_kind: bool
) -> Iterator[Difference]:
    old, new = _lines(before), _lines(after)
    gone = [text for meaning, text in old.items() if meaning not in new]
    come = [text for meaning, text in new.items() if meaning not in old]
    if before and after:
        headers = _written(before.header.span), _written(after.header.span)
        if same_kind:
            gone, come = [line for line in gone if line != headers[0]], [line for line in come if line != headers[1]]
    if gone or come:
        yield Difference(what, tuple(gone), tuple(come))


def _lines(declaration: Declaration | None) -> dict[Any, str]:
    """The header and the facts as they are written, by what they mean."""
    if declaration is None:
        return {}
    lines = (declaration.header, *declaration.facts)
    return {_meaning(line): _written(line.span) for line in lines}


def _written(span: Span) -> str:
    return " ".join(span.text.split())


def _meaning(node: Any) -> Any:
    """A tree without its places: arguments in any order, 20% as 0.2."""
    match node:
        case Amount(number, "%"):
            return ("", number * SHARE)
        case Amount(number, unit):
            return (unit, number)
        case Phrase(kind, arguments):
            return (kind.text, tuple(sorted((argument.key.text, repr(_meaning(argument.value))) for argument in arguments)))
        case tuple():
            return tuple(map(_meaning, node))
        case str() | None | bool():
            return node
    values = (_meaning(getattr(node, field.name)) for field in fields(node) if field.name != "span")
    return (type(node).__name__, *values)
