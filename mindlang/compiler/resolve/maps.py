"""Maps drawn in text files: read, and the things that their letters place."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from mindrun.errors import reason
from mindrun.quantity import Place
from mindrun.regular_files import read_regular
from mindrun.things.map import FLOOR

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.model import Part
from mindlang.compiler.source import MAX_SOURCE_BYTES, decode
from mindlang.compiler.syntax import Contains, File, Text, Value

Parts = Sequence[Part[Any]]


def text_lines(value: Value, root: Path | None, findings: Findings) -> tuple[str, ...] | None:
    """The lines of a text file that an argument names, None after reporting that it cannot be read."""
    if not isinstance(value, Text):
        hint = 'Write its name between quotation marks: map from "maze.txt".'
        findings.error("not-a-file", value.span, "Here stands the name of a text file.", hint)
        return None
    path = path_of(value)
    if path is None or (root and not path.is_relative_to(root.resolve())):
        hint = "A map is in the folder of the mind or below it; its path is relative to the file in which it stands."
        findings.error("outside-project", value.span, f'"{value.text}" is not inside the project.', hint)
        return None
    try:
        text = decode(read_regular(path, MAX_SOURCE_BYTES + 1))
    except (OSError, ValueError, RuntimeError) as error:
        why = f": {reason(error)}" if isinstance(error, OSError) else f": it {error}"
        hint = "The path is relative to the file in which it stands; a map is a text of # and . and letters."
        findings.error("unreadable-map", value.span, f"{value.text} cannot be read{why}.", hint)
        return None
    return tuple(line.rstrip() for line in text.rstrip().split("\n"))


def path_of(value: Text) -> Path | None:
    """The file that a text names beside the file in which it stands; None where that is none."""
    try:
        return (value.span.source.folder / value.text).resolve() if value.text else None
    except (OSError, RuntimeError, ValueError):  # a loop of links, a name too long
        return None


def map_paths(files: Iterable[File]) -> list[Path]:
    """The text files that the tasks and scenes of some files name."""
    facts = (fact for file in files for declaration in file.declarations for fact in declaration.facts)
    values = (each.value for fact in facts if isinstance(fact, Contains) for each in fact.phrase.arguments)
    return [path for value in values if isinstance(value, Text) and (path := path_of(value))]


def with_places(things: Parts, are_all: bool, findings: Findings) -> tuple[Part[Any], ...]:
    """The things of a task, those at a place of which a map has their letter; `are_all` where no others follow."""
    placed: dict[str, tuple[Place, ...]] = {}
    for drawn in things:
        if drawn.kind and drawn.kind.letters and not drawn.kind.mistake(None):
            for letter, places in drawn.kind.letters.items():
                if name := _named(letter, drawn, things, are_all, findings):
                    placed[name] = placed.get(name, ()) + places
    return tuple(_placed(thing, placed, findings) for thing in things)


def _named(letter: str, drawn: Part[Any], things: Parts, are_all: bool, findings: Findings) -> str | None:
    """The thing that a letter stands for, None after reporting that there is none."""
    fit = [thing.name for thing in things if thing.name.startswith(letter) and thing is not drawn]
    if letter in fit or len(fit) == 1:
        return letter if letter in fit else fit[0]
    if fit:
        hint = f"Call one of them {letter}, or let their names begin with different letters."
        message = f"The letter {letter} of this map can be {listed(fit)}."
        findings.error("ambiguous-letter", drawn.span, message, hint)
        return None
    if not are_all:
        return None
    add = f"Add contains {letter} is item to the task, or write" if letter.isalpha() and letter.islower() else "Write"
    message = f"The map has {letter!r}, which no thing of the task begins with."
    findings.error("unknown-letter", drawn.span, message, f"{add} {FLOOR} for floor.")
    return None


def _placed(thing: Part[Any], placed: Mapping[str, tuple[Place, ...]], findings: Findings) -> Part[Any]:
    places = placed.get(thing.name, ())
    if not thing.kind or not places:
        return thing
    if thing.kind.places or thing.kind.count not in (0, 1, len(places)):
        hint = "Leave its place and its count out: the map says both."
        message = f"A map places {thing.name}, and its own line says otherwise."
        findings.error("placed-twice", thing.span, message, hint)
        return thing
    return replace(thing, kind=replace(thing.kind, at=places))
