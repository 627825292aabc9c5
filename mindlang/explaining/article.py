"""The explanation of a kind, a driver, a code, a word of the language or a command, as one value; and as Markdown.

The texts beside this file have what no program says of itself: chapters, and a section a name.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from mindlang.compiler.diagnostic import a

SCALE_MARKS = ("0", "0.5", "1")
_HEADING = re.compile(r"^(#{1,2}) (.+)\n", re.M)
_EXAMPLE = re.compile(r"^```(\w+(?: \w+)?)\n(.*?)^```\n", re.M | re.S)
_MARK = re.compile(rf"^- ({'|'.join(map(re.escape, SCALE_MARKS))}): (.+)\n", re.M)


@dataclass(frozen=True, slots=True)
class Parameter:
    """An argument or option of a kind, a driver or a command: what it takes, what for, and its default.

    The default is None for a required one, and empty where there is nothing to say about it.
    """

    key: str
    meaning: str
    default: str | None = None
    purpose: str = ""

    @property
    def words(self) -> str:
        """The purpose and the meaning of a parameter, as one text."""
        return ": ".join(filter(None, (self.purpose, self.meaning)))

    @property
    def otherwise(self) -> str:
        """The default of a parameter, or that it is required, in parentheses."""
        if self.default is None:
            return " (required)"
        return f" (default: {self.default})" if self.default else ""


@dataclass(frozen=True, slots=True)
class Wire:
    """A wire to a terminal of a device, from a pin of the Raspberry Pi, or from something else where it has none."""

    source: str
    pin: int | None
    terminal: str

    @property
    def begin(self) -> str:
        """The beginning of the wire, with the number of the pin on the header."""
        return f"{self.source} (pin {self.pin})" if self.pin else self.source


@dataclass(frozen=True, slots=True)
class DeviceWiring:
    """The wires at the terminals of a device, with the pins of an example."""

    device: str
    wires: tuple[Wire, ...]


@dataclass(frozen=True, slots=True)
class Article:
    """A name and what it is: in a sentence, at length, and by examples.

    `noun` is what tells it from others of its name: "sensor", "driver", "error". `sort` says it to people, `chapter` is
    where it stands among others. `text` has paragraphs, each of them one line. `scale` has what a reading or command
    of 0, 0.5 and 1 means. `wrong` and `right` are texts in `language`; further files of one stand below `-- NAME --`.
    `wiring` is that of the device in the example.
    """

    name: str
    noun: str
    sort: str
    chapter: str
    summary: str
    text: str = ""
    parameters: tuple[Parameter, ...] = ()
    scale: Mapping[str, str] = field(default_factory=dict)
    wrong: tuple[str, ...] = ()
    right: tuple[str, ...] = ()
    language: str = "mind"
    wiring: DeviceWiring | None = None

    @property
    def paragraphs(self) -> list[str]:
        return self.text.split("\n\n") if self.text else []


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
            body = text[heading.end() : end]
            examples = tuple((label, example) for label, example in _EXAMPLE.findall(body))
            words = _EXAMPLE.sub("", body)
            marks = dict(_MARK.findall(words))
            yield Section(chapter, heading[2], *titled(_MARK.sub("", words)), marks, examples)


NO_SECTION = Section("", "", "", "", {}, ())  # of what has none


@cache
def named_sections(texts: str) -> Mapping[tuple[str, str], Section]:
    """The sections of one of these texts by their chapters and names."""
    return {(each.chapter, each.name): each for each in sections(texts)}


def titled(text: str) -> tuple[str, str]:
    """The first line of a text, and its paragraphs, each of them one line."""
    title, *paragraphs = re.split(r"\n\s*\n", text.strip())
    return title, unwrap_paragraphs("\n\n".join(paragraphs))


def unwrap_paragraphs(text: str) -> str:
    """The paragraphs of a text, each of them one line."""
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in re.split(r"\n\s*\n", text.strip()))


def article_card(article: Article) -> str:
    """The Markdown that an editor shows of an article."""
    parts = [f"**{article.name}**, {a(article.sort)}", article.summary, *article.paragraphs]
    parts += ["\n".join(f"- **{mark}** {meaning}" for mark, meaning in article.scale.items())]
    parts += ["\n".join(f"- {parameter_line(each)}" for each in article.parameters)]
    parts += [fenced(text, article.language) for text in article.right]
    return "\n\n".join(filter(None, parts))


def parameter_line(parameter: Parameter) -> str:
    """An argument in a line: what it takes, and its default."""
    return f"`{parameter.key}` {parameter.words}{parameter.otherwise}"


def fenced(text: str, language: str) -> str:
    """A text as a block of code."""
    return f"```{language}\n{text.rstrip()}\n```"
