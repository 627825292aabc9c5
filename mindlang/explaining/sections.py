"""The texts beside this file, in which people wrote what no program says of itself: chapters, and a section a name."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from mindlang.explaining.article import SCALE_MARKS

_HEADING = re.compile(r"^(#{1,2}) (.+)\n", re.M)
_EXAMPLE = re.compile(r"^```(\w+(?: \w+)?)\n(.*?)^```\n", re.M | re.S)
_MARK = re.compile(rf"^- ({'|'.join(map(re.escape, SCALE_MARKS))}): (.+)\n", re.M)


@dataclass(frozen=True, slots=True)
class Section:
    """A name below its chapter: a sentence, paragraphs, what 0, 0.5 and 1 are, and examples, each with its label."""

    chapter: str
    name: str
    title: str
    text: str
    scale: Mapping[str, str]
    examples: tuple[tuple[str, str], ...]

    def labelled(self, label: str) -> tuple[str, ...]:
        """The examples with a label."""
        return tuple(text for each, text in self.examples if each == label)


def sections(name: str | Path) -> Iterator[Section]:
    """The sections of one of these texts, or of one elsewhere, in their order."""
    text = (Path(__file__).parent / name).read_text(encoding="utf-8")
    fences = [found.span() for found in _EXAMPLE.finditer(text)]
    headings = [each for each in _HEADING.finditer(text) if not any(a <= each.start() < b for a, b in fences)]
    ends = [*(each.start() for each in headings[1:]), len(text)]
    chapter = ""
    for heading, end in zip(headings, ends, strict=True):
        if heading[1] == "#":
            chapter = heading[2]
        else:
            yield _section(chapter, heading[2], text[heading.end() : end])


def _section(chapter: str, name: str, body: str) -> Section:
    examples = tuple((label, text) for label, text in _EXAMPLE.findall(body))
    words = _EXAMPLE.sub("", body)
    return Section(chapter, name, *titled(_MARK.sub("", words)), dict(_MARK.findall(words)), examples)


def titled(text: str) -> tuple[str, str]:
    """The first line of a text, and its paragraphs, each of them one line."""
    title, *paragraphs = re.split(r"\n\s*\n", text.strip())
    return title, in_lines("\n\n".join(paragraphs))


def in_lines(text: str) -> str:
    """The paragraphs of a text, each of them one line."""
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in re.split(r"\n\s*\n", text.strip()))
