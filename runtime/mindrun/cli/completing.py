"""What a shell completes of the words of mindrun: tools, options, choices, files of the kind, names in the bundle."""

from argparse import Action, ArgumentParser
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from mindrun.cli.driving_arguments import driving_parser
from mindrun.cli.shell_completion import FILES, Answer
from mindrun.cli.tools import tool_parser, tools
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, read_bundle
from mindrun.terminal.arguments import new_file

SUFFIXES = {"bundle": ".bundle", "recording": ".rec", "breaks": ".break"}  # of the files that an argument takes
OTHER_FILES = {"readings"}


def _wired(bundle: Bundle) -> Iterator[str]:
    yield from (wire.sensor for wire in bundle.wiring.sensors) if bundle.wiring else ()


NAMES: Mapping[str, Callable[[Bundle], Iterable[str]]] = {  # that an argument takes, in the bundle on the line
    "master": lambda bundle: (skill.name for skill in bundle.graph.skills),
    "task": lambda bundle: (task.name for task in bundle.graph.tasks),
    "sensor": _wired,
}


def answers(before: list[str], begun: str) -> Iterator[Answer]:
    """What may stand in the place of the word that is begun, behind those that are before it."""
    if not before:
        yield from (Answer(name, _summary(tool_parser(name))) for name in tools() if name.startswith(begun))
    tool = before[0] if before and before[0] in tools() else None
    parser = tool_parser(tool) if tool else driving_parser()
    yield from _arguments(parser, before[1:] if tool else before, begun)


def _arguments(parser: ArgumentParser, before: list[str], begun: str) -> Iterator[Answer]:
    """The same, of one parser."""
    options = {name: action for action in parser._actions for name in action.option_strings}
    places = [action for action in parser._actions if not action.option_strings]
    value: Action | None = None  # the option whose value comes next
    for word in before:
        if value:
            value = None
        elif action := options.get(word.partition("=")[0]):
            options = {name: other for name, other in options.items() if other is not action}
            value = action if action.nargs != 0 and "=" not in word else None
        else:
            places = places[1:]
    if value:
        yield from _values(value, before, begun)
    elif begun.startswith("-"):
        long = {action.option_strings[-1]: action for action in options.values()}
        yield from (Answer(name, action.help or "") for name, action in long.items() if name.startswith(begun))
    elif places:
        yield from _values(places[0], before, begun)


def _values(action: Action, before: list[str], begun: str) -> Iterator[Answer]:
    """What an argument may be."""
    named = NAMES.get(action.dest)
    known = action.choices or (named(bundle) if named and (bundle := _bundle(before)) else ())
    yield from (Answer(name) for name in dict.fromkeys(map(str, known)) if name.startswith(begun))
    if action.dest in SUFFIXES or action.dest in OTHER_FILES or action.type in (Path, new_file):
        yield Answer(SUFFIXES.get(action.dest, ""), kind=FILES)


def _bundle(words: list[str]) -> Bundle | None:
    """The bundle that stands on the line; None where there is none that can be read."""
    for word in words:
        if word.endswith(SUFFIXES["bundle"]):
            try:
                return read_bundle(Path(word).expanduser())
            except MindError:
                return None  # nobody has asked for a message in the middle of a line
    return None


def _summary(parser: ArgumentParser) -> str:
    """The first sentence of what a tool does."""
    return (parser.description or "").replace("\n", " ").partition(". ")[0].rstrip(".")
