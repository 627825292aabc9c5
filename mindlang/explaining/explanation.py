"""Every code with its explanation, from `errors.md` and from the lint rules."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ERRORS, RULES = "error", "lint rule"

_HEADING = re.compile(r"^(#{1,2}) (.+)\n", re.M)
_EXAMPLE = re.compile(r"^```mind (bad|good)\n(.*?)^```\n", re.M | re.S)


@dataclass(frozen=True, slots=True)
class Explanation:
    """A code, its sort and its chapter; what it means, in a sentence and at length; minds with it and without.

    Further files of an example stand below `-- NAME --`.
    """

    code: str
    sort: str
    chapter: str
    title: str
    text: str
    bad: tuple[str, ...]
    good: tuple[str, ...]


@cache
def explanations() -> dict[str, Explanation]:
    """All explanations by code: errors in the order of their chapters, then the lint rules."""
    return {each.code: each for each in (*errors(), *_rules())}


def errors() -> Iterator[Explanation]:
    """The explanations of `errors.md`."""
    text = Path(__file__).with_name("errors.md").read_text(encoding="utf-8")
    fences = [found.span() for found in _EXAMPLE.finditer(text)]
    headings = [each for each in _HEADING.finditer(text) if not any(a <= each.start() < b for a, b in fences)]
    ends = [*(each.start() for each in headings[1:]), len(text)]
    chapter = ""
    for heading, end in zip(headings, ends, strict=True):
        if heading[1] == "#":
            chapter = heading[2]
        else:
            yield _explained(heading[2], chapter, text[heading.end() : end])


def _explained(code: str, chapter: str, body: str) -> Explanation:
    examples = _EXAMPLE.findall(body)
    bad, good = (tuple(mind for which, mind in examples if which == wanted) for wanted in ("bad", "good"))
    return Explanation(code, ERRORS, chapter, *_titled(_EXAMPLE.sub("", body)), bad, good)


def _rules() -> Iterator[Explanation]:
    from mindlang.rules import all_rules

    for rule in all_rules().values():
        title, text = _titled(rule.text)
        bad, good = (tuple(mind.lstrip("\n") for mind in minds) for minds in (rule.bad, rule.good))
        yield Explanation(rule.code, RULES, "Lint rules", title, text, bad, good)


def _titled(text: str) -> tuple[str, str]:
    """The first line of a text, and its paragraphs, each of them one line."""
    title, *paragraphs = re.split(r"\n\s*\n", text.strip())
    return title, "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs)
