"""Parts of mindrun's command lines: parsers that take no half-said option, and types that say their bounds."""

import argparse
from collections.abc import Callable, Sequence
from math import isfinite
from pathlib import Path

MAX_SEED = 2**64 - 1  # the largest of a layout
SHOWN_CHARACTERS = 20  # of what is refused


def parser(program: str, about: str | None, examples: str | None = None) -> argparse.ArgumentParser:
    """A parser that knows options by their whole names alone: `--a` must not arm a robot."""
    return argparse.ArgumentParser(
        program, description=about, epilog=examples, allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip


def whole(least: int, most: int) -> Callable[[str], int]:
    """A whole number in a range."""

    def convert(text: str) -> int:
        if text.isascii() and text.isdigit() and len(text) <= SHOWN_CHARACTERS and least <= int(text) <= most:
            return int(text)
        raise argparse.ArgumentTypeError(f"{shortened(text)} is not a whole number from {least} to {most}")

    return convert


def real(least: float, most: float) -> Callable[[str], float]:
    """A number in a range."""

    def convert(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if isfinite(value) and least <= value <= most:
            return value + 0.0  # there is no -0
        raise argparse.ArgumentTypeError(f"{shortened(text)} is not a number from {least:g} to {most:g}")

    return convert


def new_file(text: str) -> Path:
    """The path of a file that is to be written."""
    if text.endswith("/") or Path(text).name in ("", ".."):
        raise argparse.ArgumentTypeError(f"{text!r} names no file")
    return Path(text)


def listed_names(text: str) -> tuple[str, ...]:
    """Names with commas between them, each once."""
    return tuple(dict.fromkeys(name.strip() for name in text.split(",")))


def emptiness(words: Sequence[str]) -> str:
    """The flaw of a command line, given as its words, of which one is empty or blank; "" where none is.

    No argument of ours may be: most often it is a variable of a shell that was never set.
    """
    for before, word in zip(["", *words], words, strict=False):
        option, equals, value = word.partition("=")
        if equals and option.startswith("--") and not value.strip():
            return f"what stands behind {option} is empty"
        if not word.strip():
            return f"what stands behind {before} is empty" if before else "the first word is empty"
    return ""


def shortened(text: str) -> str:
    """The text of a user, cut to a length that fits into a sentence; "nothing" for none."""
    return text if 0 < len(text) <= SHOWN_CHARACTERS else f"{text[:SHOWN_CHARACTERS]}…" if text else "nothing"
