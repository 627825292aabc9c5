"""Explanations on a terminal and as data."""

from collections.abc import Iterable, Iterator
from itertools import groupby
from textwrap import fill, indent
from typing import Any

from mindlang.explaining.explanation import ERRORS, Explanation

PAGE_COLUMNS = 80
Segment = tuple[str, str]  # text and style


def describe_explanation(explanation: Explanation) -> Iterator[Segment]:
    """One explanation, with its examples."""
    yield explanation.code, "bold"
    yield f" ({explanation.sort})\n", "dim"
    yield f"{explanation.title}\n", ""
    for paragraph in explanation.text.split("\n\n"):
        yield f"\n{fill(paragraph, PAGE_COLUMNS, break_on_hyphens=False)}\n", ""
    for heading, style, minds in (("Wrong", "red", explanation.bad), ("Right", "green", explanation.good)):
        for mind in minds:
            yield f"\n{heading}:\n", style
            yield f"{indent(mind.rstrip(), '  ')}\n", ""


def contents(explanations: Iterable[Explanation]) -> Iterator[Segment]:
    """All codes with their sentences, by chapter."""
    known = list(explanations)
    wide = max(len(each.code) for each in known)
    for (sort, chapter), group in groupby(known, key=lambda each: (each.sort, each.chapter)):
        yield f"Errors: {chapter}\n" if sort == ERRORS else f"{chapter}\n", "bold"
        for each in group:
            yield f"  {each.code:{wide}}", "cyan"
            yield f"  {each.title}\n", ""
        yield "\n", ""
    yield "mindc explain CODE says more.\n", "dim"


def as_data(explanation: Explanation) -> dict[str, Any]:
    """An explanation as plain data."""
    return {
        "code": explanation.code,
        "sort": explanation.sort,
        "chapter": explanation.chapter,
        "title": explanation.title,
        "text": explanation.text,
        "wrong": list(explanation.bad),
        "right": list(explanation.good),
    }
