"""Compiles files, for any input without an exception: text → File → Mind → Graph.

The files of a mind are the main one and those that it uses, all of them inside the project.
"""

import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mindrun.errors import reason
from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import Graph
from mindrun.numbers.short_repr import ShortRepr
from msgspec import structs

from mindlang.compiler.diagnostic import Diagnostic, Findings, near_file
from mindlang.compiler.families import each_family_once
from mindlang.compiler.lower import lower
from mindlang.compiler.model import Mind
from mindlang.compiler.names import declared_names, mentions
from mindlang.compiler.parse import parse
from mindlang.compiler.resolve import resolve_mind
from mindlang.compiler.source import MAX_SOURCE_BYTES, Source, Span, checked_text, decode_source
from mindlang.compiler.syntax import Amount, File, Name, Use, of_form, rebuilt

STDIN = "<stdin>"
SHELLS_PIPE = re.compile(r"/(?:dev|proc/self)/fd/\d+|/dev/stdin")  # <(git show HEAD:collect.mind)
NO_TEXTS: Mapping[Path, str] = {}
MAX_USE_DEPTH = 64


@dataclass(frozen=True, slots=True, repr=False)
class Compiled(ShortRepr):
    """A compiled file with its diagnostics. `graph` and `mind` are None where its text has errors.

    What is wrong with the module of a procedure is an error, too, but leaves them: it stands in another file.
    """

    graph: Graph | None
    mind: Mind | None
    diagnostics: tuple[Diagnostic, ...]
    sources: tuple[Source, ...]

    @property
    def is_valid(self) -> bool:
        """True if there are no errors; warnings may be there."""
        return self.graph is not None and all(each.severity != "error" for each in self.diagnostics)

    @property
    def readable(self) -> bool:
        """True if the main file could be read."""
        return bool(self.sources)

    @property
    def whole(self) -> tuple[Mind, Graph]:
        """The mind and its graph, of a file that compiled."""
        assert self.mind
        assert self.graph
        return self.mind, self.graph


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
            return Source(str(path), checked_text(texts[resolved]), resolved.parent)
        if str(path) == "-":
            return Source(STDIN, decode_source(sys.stdin.buffer.read(MAX_SOURCE_BYTES + 1)), Path.cwd().resolve())
        if SHELLS_PIPE.fullmatch(str(path)):
            with Path(path).open("rb") as stream:
                return Source(str(path), decode_source(stream.read(MAX_SOURCE_BYTES + 1)), Path.cwd().resolve())
        return read_source(Path(path), str(path))
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
    parsed, complete = read_files(source, path, findings, texts)
    mind = resolve_mind(parsed, findings) if complete else None  # names of a missing file would all seem unknown
    graph = lower(mind) if mind else None
    if graph and mind and any(skill.function.calls is not None for skill in graph.skills):
        from mindlang.compiler.procedures import mistakes  # else nothing of Python's has to be imported

        findings.diagnostics += mistakes(graph.skills, mind, source.folder)
    sources = tuple(file.source for file in parsed)
    found = each_family_once(findings.diagnostics, [family for file in parsed for family in file.families])

    def place(of: Diagnostic) -> tuple[int, int]:
        return (sources.index(of.span.source), of.span.start) if of.span else (-1, 0)

    return Compiled(graph, mind, tuple(sorted(found, key=place)), sources)


@dataclass(slots=True)
class _Project:
    root: Path
    findings: Findings
    texts: Mapping[Path, str]
    files: dict[Path, File] = field(default_factory=dict)
    open: list[Path] = field(default_factory=list)
    complete: bool = True

    def refuse(self, code: str, use: Use, message: str, hint: str) -> None:
        """Report a file that is not read."""
        self.findings.error(code, use.span, message, hint)
        self.complete = False


def read_source(path: Path, name: str) -> Source:
    """The source at a path; OSError or ValueError says why it cannot be read."""
    if path.is_dir():
        raise ValueError("is a folder: name the files in it")
    return Source(name, decode_source(read_regular(path, MAX_SOURCE_BYTES + 1)), path.resolve().parent)


def read_files(source: Source, path: Path, findings: Findings, texts: Mapping[Path, str]) -> tuple[list[File], bool]:
    """The main file and after it, once each, the files that it uses; and whether all of them could be read.

    A file that stands in `texts` is taken from there, as an edit or an editor has it.
    """
    project = _Project(source.folder, findings, texts)
    _add(path, source, project)
    return list(project.files.values()), project.complete


def _add(path: Path, source: Source, project: _Project) -> None:
    file = under_alias(parse(source, project.findings))
    project.files[path] = file
    project.open.append(path)
    for use in of_form(file.settings, Use):
        _follow(use, project)
    project.open.pop()


def _follow(use: Use, project: _Project) -> None:
    target, alias = _inside(use, project), use.alias.text if use.alias else ""
    known = project.files.get(target) if target else None
    others = (file.source.name for file in project.files.values() if alias and file.source.alias == alias)
    if "." in alias:
        hint = f"Write as {alias.rpartition('.')[2]}."
        project.refuse("dotted-alias", use, "A file is used under one word, without a dot.", hint)
    elif target in project.open:
        loop = [*project.open[project.open.index(target) :], target]
        names = " → ".join(path.relative_to(project.root).as_posix() for path in loop)
        hint = "Move what both need into a third file, and use that in both."
        project.refuse("use-loop", use, f"Files use one another in a circle: {names}.", hint)
    elif len(project.open) > MAX_USE_DEPTH:
        hint = f"Files may use one another {MAX_USE_DEPTH} deep; use this one from nearer to the top."
        project.refuse("use-too-deep", use, "Files use one another too deep.", hint)
    elif known:
        if known.source.alias != alias:  # its declarations would have two names
            said = f"as {known.source.alias}" if known.source.alias else "without as"
            message = f"{use.path} is used {said} already, and has one name."
            project.refuse("other-alias", use, message, f"Use it {said} here, too.")
    elif other := next(others, ""):
        project.refuse("taken-alias", use, f"{other} is used as {alias} already.", f"Use {use.path} as another word.")
    elif target:
        _read(target, alias, use, project)


def _inside(use: Use, project: _Project) -> Path | None:
    """The path of the used file, or None after reporting that it is outside of the project."""
    try:
        target = (use.span.source.folder / use.path).resolve()
    except (OSError, RuntimeError, ValueError):  # a loop of links, a name too long
        target = Path("/")
    if use.path and not Path(use.path).is_absolute() and target.is_relative_to(project.root):
        return target
    hint = f"Use files in the folder {project.root.name} or below it, by a relative path."
    project.refuse("outside-project", use, f'"{use.path}" is not inside the project.', hint)
    return None


def _read(target: Path, alias: str, use: Use, project: _Project) -> None:
    name = Path(use.span.source.name).parent.joinpath(use.path).as_posix()
    try:
        text = project.texts.get(target)
        source = read_source(target, name) if text is None else Source(name, checked_text(text), target.parent)
        source = replace(source, alias=alias)
    except (OSError, RuntimeError) as error:  # a loop of links is a RuntimeError
        hint = "The path is relative to the file in which it stands."
        project.refuse("unreadable-use", use, f"{use.path} cannot be read: {reason(error)}.", hint)
    except ValueError as error:
        project.refuse("unreadable-use", use, f"{use.path} {error}.", "Use a .mind file.")
    else:
        _add(target, source, project)


def under_alias(file: File) -> File:
    """The file with the names that it declares as other files say them, `walls.Grab`; itself where it has no alias."""
    if not file.source.alias:
        return file
    names = declared_names([file], Findings())
    own = {mention.name.span for mention in mentions([file], names) if mention.noun not in ("thing", "draw")}

    def renamed(node: Any) -> Any:
        match node:
            case Name(text, span) if span in own:
                return Name(f"{file.source.alias}.{text}", span)
            case Amount(name=name) if name and node.constant.span in own:
                return structs.replace(node, name=f"{file.source.alias}.{name}")
        return node

    found: File = rebuilt(file, renamed)
    return found
