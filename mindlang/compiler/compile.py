"""The way through: text → File → Mind → Graph, for any input without an exception."""

import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from mindrun.errors import reason
from mindrun.graph.graph import Graph
from mindrun.numbers.short_repr import ShortRepr

from mindlang.compiler.diagnostic import Diagnostic, Findings, near_file
from mindlang.compiler.lower import lower
from mindlang.compiler.model import Mind
from mindlang.compiler.resolve import resolve
from mindlang.compiler.source import MAX_SOURCE_BYTES, Source, Span, decode, within
from mindlang.compiler.syntax import File
from mindlang.compiler.use import files, read

STDIN = "<stdin>"
SHELLS_PIPE = re.compile(r"/(?:dev|proc/self)/fd/\d+|/dev/stdin")  # <(git show HEAD:collect.mind)
NO_TEXTS: Mapping[Path, str] = {}


@dataclass(frozen=True, slots=True, repr=False)
class Compiled(ShortRepr):
    """What became of a file. `graph` and `mind` are None where its text has errors.

    What is wrong with the module of a procedure is an error, too, but leaves them: it stands in another file.
    """

    graph: Graph | None
    mind: Mind | None
    diagnostics: tuple[Diagnostic, ...]
    sources: tuple[Source, ...]

    @property
    def is_valid(self) -> bool:
        """Whether nothing is wrong; warnings are nothing."""
        return self.graph is not None and all(each.severity != "error" for each in self.diagnostics)

    @property
    def readable(self) -> bool:
        """Whether the main file could be read at all."""
        return bool(self.sources)


def load(path: Path | str, texts: Mapping[Path, str] = NO_TEXTS) -> Compiled:
    """The file at `path`, or with "-" standard input, compiled; whatever is wrong is in the diagnostics.

    Files that stand in `texts` are taken from there.
    """
    source = read_main(path, texts)
    if isinstance(source, Diagnostic):
        return Compiled(None, None, (source,), ())
    return compile_source(source, Path(path).resolve(), texts)


def read_main(path: Path | str, texts: Mapping[Path, str] = NO_TEXTS) -> Source | Diagnostic:
    """The source at `path`, or with "-" standard input, or why it cannot be read."""
    try:
        resolved = Path(path).resolve()
        if resolved in texts:
            return Source(str(path), within(texts[resolved]), resolved.parent)
        if str(path) == "-":
            return Source(STDIN, decode(sys.stdin.buffer.read(MAX_SOURCE_BYTES + 1)), Path.cwd().resolve())
        if SHELLS_PIPE.fullmatch(str(path)):
            with Path(path).open("rb") as stream:
                return Source(str(path), decode(stream.read(MAX_SOURCE_BYTES + 1)), Path.cwd().resolve())
        return read(Path(path), str(path))
    except (OSError, RuntimeError) as error:
        # a loop of links is a RuntimeError
        name, hint = (STDIN, "") if str(path) == "-" else (path, near_file(Path(path)))
        return Diagnostic("unreadable", f"{name} cannot be read: {reason(error)}.", None, hint)
    except ValueError as error:
        hint = f"A .mind file is UTF-8 text of at most {MAX_SOURCE_BYTES >> 20} MiB."
        return Diagnostic("unreadable", f"{path} {error}.", None, hint)


def compile_source(source: Source, path: Path = Path("-"), texts: Mapping[Path, str] = NO_TEXTS) -> Compiled:
    """A source that has been read, compiled together with the files that it uses; those in `texts` are not read."""
    findings = Findings()
    if not any(line.strip() and not line.lstrip().startswith("#") for line in source.text.split("\n")):
        hint = "A file needs a tick, a master, a body, actuators, sensors and skills: mindc show one of the examples."
        diagnostic = Diagnostic("empty-file", "There is nothing in this file.", Span(source, 0, 0), hint)
        return Compiled(None, None, (diagnostic,), (source,))
    parsed, complete = files(source, path, findings, texts)
    mind = resolve(parsed, findings) if complete else None  # names of a missing file would all seem unknown
    graph = lower(mind) if mind else None
    if graph and mind:
        findings.diagnostics += _procedure_mistakes(graph, mind, source.folder)
    return Compiled(graph, mind, _sorted(findings, parsed), tuple(file.source for file in parsed))


def _procedure_mistakes(graph: Graph, mind: Mind, folder: Path) -> Iterator[Diagnostic]:
    """What is wrong with the modules of procedures."""
    if any(skill.function.calls is not None for skill in graph.skills):  # else nothing of Python's has to be imported
        from mindlang.compiler.procedures import mistakes

        yield from mistakes(graph.skills, mind, folder)


def _sorted(findings: Findings, parsed: list[File]) -> tuple[Diagnostic, ...]:
    """The diagnostics file by file, in the order of their lines."""
    order = {id(file.source): index for index, file in enumerate(parsed)}
    return tuple(
        sorted(findings.diagnostics, key=lambda d: (order[id(d.span.source)], d.span.start) if d.span else (-1, 0))
    )
