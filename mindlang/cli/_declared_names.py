"""What a shell completes from the mind that stands on the line: names that are declared there, mistakes or not."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import click
from click.shell_completion import CompletionItem

Completion = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]


def declared(*nouns: str) -> Completion:
    """What completes a parameter with the names that are declared with one of these nouns; without one, with all."""

    def found(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
        said = context.params.get(parameter.name or "")
        there = {*said} if isinstance(said, tuple) else set()
        known = {name: noun for noun, name in _declarations(_minds(context, parameter)) if not nouns or noun in nouns}
        return [
            CompletionItem(name, help=noun)
            for name, noun in known.items()
            if name.startswith(begun) and name not in there
        ]

    return found


def _declarations(minds: Iterable[Path]) -> Iterator[tuple[str, str]]:
    """The noun and the name of each declaration in these files, and in those that they use."""
    from mindlang.compiler.compile import files, read
    from mindlang.compiler.diagnostic import Findings

    for mind in minds:
        try:
            source = read(mind, str(mind))
        except (OSError, ValueError):
            continue  # nobody has asked for a message in the middle of a line
        for file in files(source, mind.resolve(), Findings(), {})[0]:
            yield from ((each.header.noun.text, each.header.name.text) for each in file.declarations)


def _minds(context: click.Context, parameter: click.Parameter) -> list[Path]:
    """The .mind files before this word. An option may stand before the file: then they are those of this folder."""
    values = [*context.params.values(), *context.args]  # before the value of an option, arguments are not sorted yet
    said = [word for value in values for word in (value if isinstance(value, tuple) else [value])]
    found = [Path(word) for word in said if isinstance(word, str) and word.endswith(".mind")]
    return found or ([*Path().glob("*.mind")] if isinstance(parameter, click.Option) else [])


SKILLS, TASKS = declared("skill"), declared("task")
