"""What there is to say of a kind, a driver, a code, a word of the language or a command: one value for all who ask."""

from collections.abc import Mapping
from dataclasses import dataclass, field

SCALE_MARKS = ("0", "0.5", "1")


@dataclass(frozen=True, slots=True)
class Parameter:
    """What can be said to a kind, a driver or a command: what it takes, what for, and what holds where it is not said.

    The default is None where it has to be said, and empty where there is nothing to say about it.
    """

    key: str
    meaning: str
    default: str | None = None
    purpose: str = ""

    @property
    def words(self) -> str:
        """What it is for and what it takes."""
        return ": ".join(filter(None, (self.purpose, self.meaning)))

    @property
    def otherwise(self) -> str:
        """What holds where it is not said, or that it must be, in parentheses."""
        if self.default is None:
            return " (required)"
        return f" (default: {self.default})" if self.default else ""


@dataclass(frozen=True, slots=True)
class Wire:
    """From what to which terminal of a device: a pin of the Raspberry Pi, or something else where it has none."""

    source: str
    pin: int | None
    terminal: str

    @property
    def begin(self) -> str:
        """Where it begins, with the number of the pin on the header."""
        return f"{self.source} (pin {self.pin})" if self.pin else self.source


@dataclass(frozen=True, slots=True)
class Wiring:
    """What is connected to the terminals of a device, with the pins of an example."""

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
    wiring: Wiring | None = None

    @property
    def paragraphs(self) -> list[str]:
        """The paragraphs of its text."""
        return self.text.split("\n\n") if self.text else []
