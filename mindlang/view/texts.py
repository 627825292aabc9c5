"""Texts of a mind, of a recording or of breakpoints as a page may show them, whoever wrote them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from mindrun.errors import MindError
from mindrun.files.printable import visible

if TYPE_CHECKING:
    from mindlang.breakpoints.watch import Stop


SHOWN_CHARACTERS = 200


def shown(text: str) -> str:
    """The text with control and direction characters spelt out, and no longer than a page can show."""
    spelt = visible(text[: SHOWN_CHARACTERS + 1])
    return spelt if len(spelt) <= SHOWN_CHARACTERS else spelt[: SHOWN_CHARACTERS - 1] + "…"


def error_text(error: MindError) -> str:
    """What is wrong, and what to do."""
    return shown("; ".join(filter(None, (str(error), error.hint))))


def stop_texts(stops: Iterable[Stop]) -> tuple[tuple[int, str], ...]:
    """The tick of each stop, and which line it is of."""
    return tuple((stop.tick, shown(f"line {stop.breakpoint.line}: {stop.breakpoint.text}")) for stop in stops)
