"""Maps drawn in text files: read, or recognised in the forms of others, and the things that their letters place."""

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from mindrun.errors import reason
from mindrun.files.regular_files import read_regular
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.map import FLOOR, START, WALL
from mindrun.numbers.quantity import Place
from msgspec.structs import replace

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.model import Thing
from mindlang.compiler.source import MAX_SOURCE_BYTES, Span, decode_source
from mindlang.compiler.syntax import Contains, File, Teaches, Text, Uses, Value, of_form

MAX_SHOWN_LETTERS = 3  # of those that nothing begins with
PICTURES = re.compile(rb"P[1-6]\s|\x89PNG|\xff\xd8\xff|GIF8|BM")
ROS = re.compile(r"^\s*(image|resolution|occupied_thresh)\s*:", re.M)
DRAWING = re.compile(r"[+o]-{2,}[+o]")  # two posts and the wall between them, as those of micromouse contests have
IMPORT = "mindc import map"
SQUARES = f"A map is a text: a line for each row of squares, {WALL} where one is wall and {FLOOR} where it is floor"

Things = Sequence[Thing]


def text_lines(value: Value, root: Path | None, findings: Findings) -> tuple[str, ...] | None:
    """The lines of a text file that an argument names, None after reporting that it cannot be read."""
    if not isinstance(value, Text):
        hint = 'Write its name between quotation marks: map from "maze.txt".'
        findings.error("not-a-file", value.span, "Here stands the name of a text file.", hint)
        return None
    hint = "A map is in the folder of the mind or below it; its path is relative to the file in which it stands."
    if (path := path_inside(value, root, hint, findings)) is None:
        return None
    try:
        data = read_regular(path, MAX_SOURCE_BYTES + 1)
        text = "" if PICTURES.match(data) else decode_source(data)
    except (OSError, ValueError, RuntimeError) as error:
        why = why_unread(error)
        hint = "The path is relative to the file in which it stands; a map is a text of # and . and letters."
    else:
        hint = f"{SQUARES}. {IMPORT} {value.text} -o walls.txt makes one of it."
        if PICTURES.match(data):
            why, hint = "is a picture", f"{SQUARES}. {IMPORT} map.yaml makes one of a picture of ROS."
        elif len({found.group(1) for found in ROS.finditer(text)}) > 1:
            why = "is the YAML file of a map of ROS, and no drawing"
        elif DRAWING.search(text):
            why = "is a maze drawn with + - |"
        else:
            return tuple(line.rstrip() for line in text.rstrip().split("\n"))
    findings.error("unreadable-map", value.span, f"{value.text} {why}.", hint)
    return None


def path_inside(value: Text, root: Path | None, hint: str, findings: Findings) -> Path | None:
    """The file that a text names in the project's folder or below it; None after reporting that it is elsewhere."""
    path = path_of(value)
    if path is None or (root and not path.is_relative_to(root.resolve())):
        findings.error("outside-project", value.span, f'"{value.text}" is not inside the project.', hint)
        return None
    return path


def why_unread(error: Exception) -> str:
    """The reason why a text cannot be read or decoded, behind the name of its file."""
    return f"cannot be read: {reason(error) if isinstance(error, OSError) else f'it {error}'}"


def path_of(value: Text) -> Path | None:
    """The file that a text names beside the file in which it stands; None where that is none."""
    try:
        return (value.span.source.folder / value.text).resolve() if value.text else None
    except (OSError, RuntimeError, ValueError):  # a loop of links, a name too long
        return None


def map_paths(files: Iterable[File]) -> list[Path]:
    """The text files that tasks, scenes and lessons name, and the files that procedures use."""
    facts = [fact for file in files for declaration in file.declarations for fact in declaration.facts]
    values = [each.value for fact in of_form(facts, Contains) for each in fact.phrase.arguments]
    values += [each.value for fact in of_form(facts, Teaches) for each in fact.arguments]
    values += [fact.file for fact in of_form(facts, Uses)]
    return [path for value in values if isinstance(value, Text) and (path := path_of(value))]


def with_places(things: Things, scene: SceneKind | None, are_all: bool, findings: Findings) -> tuple[Thing, ...]:
    """The things of a task, those at a place of which a map has their letter; `are_all` where no others follow."""
    placed: dict[str, tuple[Place, ...]] = {}
    for drawn in things:
        if drawn.kind and not drawn.kind.mistake(None):
            for name, places in _named(drawn, things, are_all, findings):
                placed[name] = placed.get(name, ()) + places
    return tuple(_placed(thing, placed.get(thing.name), scene, findings) for thing in things)


def _named(drawn: Thing, things: Things, are_all: bool, findings: Findings) -> Iterator[tuple[str, tuple[Place, ...]]]:
    """The things that the letters of a map stand for, and their places; other letters are reported."""
    unknown = []
    for letter, places in drawn.kind.letters.items():
        if letter == START:
            continue
        small = letter.lower()
        fit = [thing.name for thing in things if thing.name.startswith(small) and thing is not drawn]
        if small in fit or len(fit) == 1:
            yield small if small in fit else fit[0], places
        elif fit:
            hint = f"Call one of them {small}, or let their names begin with different letters."
            message = f"The letter {letter} of this map can be {listed(fit)}."
            findings.error("ambiguous-letter", drawn.span, message, hint)
        else:
            unknown.append(letter)
    if unknown and are_all:
        shown = [repr(letter) for letter in unknown[:MAX_SHOWN_LETTERS]]
        more = [f"{len(unknown) - len(shown)} more"] if len(unknown) > len(shown) else []
        names = [letter.lower() for letter in unknown if letter.isalpha()]
        add = f"Add contains {names[0]} is item to the task, or write" if names else "Write"
        message = f"The map has {listed(shown + more, 'and')}, which no thing of the task begins with."
        findings.error("unknown-letter", drawn.span, message, f"{add} {FLOOR} for floor and {WALL} for wall.")


def map_start(things: Things, findings: Findings) -> tuple[Place, Span] | None:
    """The place at which a map of these things has the robot start, and where that map stands; None where none has."""
    drawn = [thing for thing in things if thing.kind and not thing.kind.mistake(None)]
    found = [(place, thing.span) for thing in drawn for place in thing.kind.letters.get(START, ())]
    if len(found) > 1:
        hint = f"Leave one {START} where the robot starts; any other letter is that of a thing."
        findings.error("placed-twice", found[-1][1], f"The map has {len(found)} {START}: a robot starts once.", hint)
    return found[0] if found else None


def _placed(thing: Thing, places: tuple[Place, ...] | None, scene: SceneKind | None, findings: Findings) -> Thing:
    """A thing at the places that a map has for it, None where it has none."""
    if not thing.kind or not places or thing.kind.mistake(None):
        return thing
    kind = thing.kind.at_places(places)
    if kind is None:
        message = f"A map places {thing.name}, and its own line says otherwise."
        findings.error("placed-twice", thing.span, message, thing.kind.unplaceable)
    elif found := kind.mistake(scene):
        findings.error(found.code, thing.span, found.message, found.hint)
    return replace(thing, kind=kind or thing.kind)
