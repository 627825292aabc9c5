"""A file that is used under a name: what it declares has that name before its own, and its own lines mean that."""

from collections.abc import Set
from dataclasses import dataclass
from typing import Any

from msgspec import Struct
from msgspec.structs import astuple, replace

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.names import gather
from mindlang.compiler.references import mentions
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Amount, File, Name


def under_alias(file: File) -> File:
    """The file with the names that it declares as other files say them, `walls.Grab`; itself where it has no alias."""
    if not file.source.alias:
        return file
    names = gather([file], Findings())
    own = {mention.name.span for mention in mentions([file], names) if mention.noun != "thing"}
    renamed: File = _Renaming(f"{file.source.alias}.", own).node(file)
    return renamed


@dataclass(frozen=True, slots=True)
class _Renaming:
    prefix: str
    own: Set[Span]

    def node(self, node: Any) -> Any:
        """A part of the file with the prefix before its own names; each keeps its place."""
        match node:
            case Name(text, span):
                return Name(self.prefix + text, span) if span in self.own else node
            case Amount(name=name) if name:
                return replace(node, name=self.prefix + name) if node.constant.span in self.own else node
            case Source() | Span():
                return node
            case tuple():
                return tuple(self.node(part) for part in node)
            case Struct():
                return type(node)(*map(self.node, astuple(node)))
        return node
