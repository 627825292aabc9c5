"""What is wrong with a file: the compiler's errors or, where there are none, what the rules find."""

import re
from collections.abc import Collection, Iterator

from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.references import mentions
from mindlang.editing.neighbours import neighbours
from mindlang.lint.rules import Rule, all_rules
from mindlang.lint.study import Finding, study

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
    found = [_diagnostic(rule, finding) for rule in held if not rule.elsewhere for finding in rule.check(about)]
    useless = [_diagnostic(rule, finding) for rule in held if rule.elsewhere for finding in rule.check(about)]
    if useless:
        named = _named_elsewhere(compiled)
        found += [each for each in useless if each.span and each.span.text not in named]
    main = compiled.sources[0]
    own = [each for each in found if each.span and each.span.source is main and not _is_silenced(each)]
    return [*compiled.diagnostics, *sorted(own, key=lambda each: (each.span.start if each.span else 0, each.code))]


def _named_elsewhere(compiled: Compiled) -> set[str]:
    """Every name of this mind's that stands in a file of another mind that uses it: not what that declares for itself.

    Minds that only use the same files have no say.
    """
    main, own = compiled.sources[0].path, {source.path for source in compiled.sources}
    users = (user.mind for user in neighbours([main]) if user.mind)
    found = (each for user in users for each in mentions(user.files, user.names))
    return {each.name.text for each in found if not each.is_own and each.name.span.source.path not in own}


def _diagnostic(rule: Rule, of: Finding) -> Diagnostic:
    return Diagnostic(rule.code, of.message, of.span, of.hint, of.labels, "warning", of.fix)


def _is_silenced(diagnostic: Diagnostic) -> bool:
    """Whether `# noqa` or `# noqa: CODE` stands on the line."""
    assert diagnostic.span
    line = diagnostic.span.source.line(diagnostic.span.line)
    found = _NOQA.search(line)
    return found is not None and (found["codes"] is None or diagnostic.code in _codes(found["codes"]))


def _codes(text: str) -> Iterator[str]:
    return (code.strip() for code in text.replace(",", " ").split())
