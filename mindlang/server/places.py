"""The lines and the nodes of a syntax tree around a place in a file."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from mindrun.kinds import registry
from mindrun.kinds.registry import arguments, kinds
from msgspec import Struct
from msgspec.structs import astuple

from mindlang.compiler import syntax
from mindlang.compiler.resolve.curricula import USING
from mindlang.compiler.source import Span


def declaration_at(file: syntax.File, offset: int) -> syntax.Declaration | None:
    """The declaration to which a line at an offset belongs: the one whose header stands last before it."""
    lines: dict[int, syntax.Declaration | None] = dict.fromkeys(each.span.start for each in file.settings)
    lines |= {each.header.span.start: each for each in reversed(file.declarations)}  # of a family the first
    return lines.get(max((start for start in lines if start <= offset), default=-1))


def on_line(span: Span, offset: int) -> bool:
    """True if an offset lies on the line of a span."""
    text = span.source.text
    end = text.find("\n", span.end)
    return text.rfind("\n", 0, span.start) < offset <= (len(text) if end < 0 else end)


def path_to(nodes: Iterable[Any], offset: int) -> list[Any]:
    """The nodes that hold an offset, of some or inside the one before; a declaration holds what stands in it."""
    path: list[Any] = []
    while (found := next((node for node in nodes if _holds(node, offset)), None)) is not None:
        path.append(found)
        nodes = _parts(found)
    return path


def _parts(node: Any) -> Iterator[Any]:
    for value in node if isinstance(node, tuple) else astuple(node):
        if isinstance(value, tuple):
            yield from _parts(value)
        elif isinstance(value, Struct):
            yield value


def _holds(node: Any, offset: int) -> bool:
    span = getattr(node, "span", None)
    if span is None:
        return any(_holds(part, offset) for part in _parts(node))
    return bool(span.start <= offset <= span.end)


def noun_of_kind(around: object) -> str:
    """The noun of the kind that a phrase names, told by the node around it."""
    match around:
        case syntax.Header(noun=noun):
            return noun.text
        case syntax.Contains():
            return "content"
        case syntax.Expression():
            return "measure"
    return "event"


@dataclass(frozen=True, slots=True)
class SaidArgument:
    """An argument in a line, with all that stand beside it, and the noun and the name of the kind that has it."""

    noun: str
    kind: str
    argument: syntax.Argument
    beside: Sequence[syntax.Argument]

    @property
    def meaning(self) -> registry.Argument | None:
        """The argument as the kind has it; None where it has none of this key."""
        cls = kinds(self.noun).get(self.kind)
        return next((each for each in arguments(cls) if each.key == self.argument.key.text), None) if cls else None


def said_argument(path: Sequence[Any], above: syntax.Declaration | None) -> SaidArgument | None:
    """The argument among the nodes that hold a place; that of a lesson is of its learner, or of the curriculum's."""
    for around, of, argument in zip([None, *path], path, path[1:], strict=False):
        match of, argument:
            case syntax.Teaches(), syntax.Argument():
                own = next((each.value for each in of.arguments if each.key.text == USING), None)
                learner = own or (above.header.phrase.kind if above and above.header.phrase else None)
                return SaidArgument("curriculum", getattr(learner, "text", ""), argument, of.arguments)
            case syntax.Phrase(), syntax.Argument():
                return SaidArgument(noun_of_kind(around), of.kind.text, argument, of.arguments)
    return None
