"""Checks a file: the compiler's errors or, where there are none, the findings of the rules; mends them on demand."""

import re
from bisect import bisect_right, insort
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, replace
from operator import attrgetter
from pathlib import Path
from typing import Any

from mindrun.files.regular_files import read_regular

from mindlang.compiler.compile import Compiled, compile_source, load
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.families import each_family_once
from mindlang.compiler.names import mentions
from mindlang.compiler.source import Source, Splice, encode_source, spliced
from mindlang.editing import transaction
from mindlang.editing.neighbours import neighbours
from mindlang.lint.rules import all_rules
from mindlang.lint.study import Finding, Rule, Study, study
from mindlang.lock import LockError

MAX_FIX_ROUNDS = 100  # a fix may make room for another
MAX_FIXED_CHARACTERS = 4 << 20  # that are looked at in all rounds: what is left of a long file is for the next time
_NOQA = re.compile(r"#\s*noqa(?:\s*:\s*(?P<codes>[\w-]+(?:[ ,]+[\w-]+)*))?\s*$", re.IGNORECASE)


def lint(compiled: Compiled, codes: Collection[str] | None = None) -> list[Diagnostic]:
    """The diagnostics of a file in the order of its lines; `codes` are those of the rules to be held (all where None).

    Rules speak of the main file only: what a used file declares may be of use to others. LockError where a lock is
    damaged.
    """
    if compiled.graph is None:
        return list(compiled.diagnostics)
    about = study(compiled)
    held = [rule for code, rule in all_rules().items() if codes is None or code in codes]
    found = [(rule, finding) for rule in held for finding in _told(rule, about)]
    named = _named_elsewhere(compiled) if any(rule.elsewhere for rule, _ in found) else set()
    own = (
        Diagnostic(rule.code, each.message, each.span, each.hint, each.labels, "warning", each.fix)
        for rule, each in sorted(found, key=lambda pair: (pair[1].span.start, pair[0].code))
        if each.span.source is compiled.sources[0] and not (rule.elsewhere and each.span.text in named)
    )
    shown = each_family_once(own, about.mind.files[0].families)
    return [*compiled.diagnostics, *(each for each in shown if not _is_silenced(each))]


def _told(rule: Rule, about: Study) -> Iterable[Finding]:
    """What a rule finds; of those of a line that several tasks have the first."""
    found: dict[Any, Finding] = {}
    for number, each in enumerate(rule.check(about)):
        found.setdefault(each.span if rule.once_a_line else number, each)
    return found.values()


def _named_elsewhere(compiled: Compiled) -> set[str]:
    """Every name of this mind's that stands in a file of another mind that uses it: not what that declares for itself.

    Minds that only use the same files have no say.
    """
    main, own = compiled.sources[0].path, {source.path for source in compiled.sources}
    users = (user.mind for user in neighbours([main]) if user.mind)
    found = (each for user in users for each in mentions(user.files, user.names))
    return {each.name.text for each in found if not each.is_own and each.name.span.source.path not in own}


def _is_silenced(diagnostic: Diagnostic) -> bool:
    """True if `# noqa` or `# noqa: CODE` stands on the line."""
    assert diagnostic.span
    found = _NOQA.search(diagnostic.span.source.line(diagnostic.span.line))
    return found is not None and diagnostic.code in (found["codes"] or diagnostic.code).replace(",", " ").split()


@dataclass(frozen=True, slots=True)
class Linted:
    """The diagnostics of a file after `fixed` fixes; they say so if it cannot be read."""

    diagnostics: tuple[Diagnostic, ...]
    readable: bool
    fixed: int


def lint_file(file: str, compiled: Compiled, codes: Collection[str], fix: bool) -> Linted:
    """Check a file by the rules with these codes, with `fix` mend it; MindError where it cannot be written."""
    try:
        if fix and compiled.graph:
            return _mended(Path(file).resolve(), compiled, codes)
        return Linted(tuple(lint(compiled, codes)), compiled.readable, 0)
    except LockError as error:
        return Linted((Diagnostic("damaged-lock", f"{error}.", None, error.hint),), True, 0)


def _mended(path: Path, compiled: Compiled, codes: Collection[str]) -> Linted:
    """A file after its fixes; none is made where one of them would break it, or another mind that uses it."""

    def again(source: Source) -> Compiled:
        return compiled if source is compiled.sources[0] else compile_source(source, path)

    def refuse_changed() -> None:
        was = encode_source(path, compiled.sources[0].text)
        if read_regular(path, len(was) + 1) != was:
            message = f"{path.name} has been changed meanwhile"
            raise transaction.TransactionError(message, "Try again: nothing has been written.")

    source, made = apply_safe_fixes(compiled.sources[0], lambda source: lint(again(source), codes))
    users = (each.sources[0].path for each in neighbours([path]))
    if not made or again(source).graph is None or any(load(user, {path: source.text}).graph is None for user in users):
        return Linted(tuple(lint(compiled, codes)), True, 0)
    transaction.change(path.parent, {path: encode_source(path, source.text)}, refuse_changed)
    return Linted(tuple(lint(again(source), codes)), True, made)


def apply_safe_fixes(source: Source, look: Callable[[Source], Iterable[Diagnostic]]) -> tuple[Source, int]:
    """A source with all safe fixes made of what `look` finds in it, round by round, and how many those were."""
    made = 0
    for _ in range(min(MAX_FIX_ROUNDS, MAX_FIXED_CHARACTERS // max(len(source.text), 1) + 1)):
        chosen: list[Splice] = []  # that keep clear of one another, in order
        before = made
        for fix in (each.fix for each in look(source) if each.fix and each.fix.is_safe):
            own = [splice for splice in fix.splices if splice.source is source]
            if len(own) == len(fix.splices) and not any(_touches(splice, chosen) for splice in own):
                for splice in own:
                    insort(chosen, splice, key=attrgetter("start"))
                made += 1
        if made == before:
            break
        source = replace(source, text=spliced(source, chosen))
    return source, made


def _touches(splice: Splice, chosen: list[Splice]) -> bool:
    """True if a splice touches one of those that are chosen, which are in order and do not touch one another."""
    place = bisect_right(chosen, splice.end, key=attrgetter("start"))
    return place > 0 and chosen[place - 1].end >= splice.start
