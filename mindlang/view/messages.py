"""What a client may say: each message checked in every part, or a RefusedError with a sentence."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from mindrun.files.strict_json import is_whole, parsed

from mindlang.view.columns import DOUBLE_BLOCK, SINGLE_BLOCK

MAX_MESSAGE_BYTES = 16 << 10
MAX_NUMBER = (1 << 32) - 1  # as the header of a frame has it
MAX_COLUMNS = 64  # that are asked for at once
MAX_FORKS = 16
MAX_SEED = (1 << 64) - 1
SEED = re.compile("[0-9]{1,20}")
REPLACED = "reading", "influence", "memory"


class RefusedError(ValueError):
    """What cannot be answered; the sentence is for who has asked."""


@dataclass(frozen=True, slots=True)
class AskRows:
    """Ticks `first`, `first` + `every` … below `below`."""

    fork: int
    first: int
    below: int
    every: int
    ask: int


@dataclass(frozen=True, slots=True)
class AskColumns:
    """Some columns of ticks."""

    fork: int
    columns: tuple[tuple[int, int], ...]
    first: int
    below: int
    every: int
    ask: int


@dataclass(frozen=True, slots=True)
class Run:
    """Let a run go on to a tick."""

    fork: int
    to: int


@dataclass(frozen=True, slots=True)
class Why:
    """What an actuator's command of a tick consists of."""

    fork: int
    tick: int
    actuator: int


@dataclass(frozen=True, slots=True)
class AskImage:
    """What an environment draws of itself after a tick."""

    fork: int
    tick: int


@dataclass(frozen=True, slots=True)
class Change:
    """A run beside the one seen, in which something is replaced in a tick and `lasts` for so many."""

    fork: int
    tick: int
    what: str
    column: tuple[int, int]
    value: float
    lasts: int


@dataclass(frozen=True, slots=True)
class PlayChampion:
    """The champion of a generation of a training, instead of the run that is seen; `seed` None is the same world."""

    run: int
    attempt: int
    generation: int
    seed: int | None
    fork: int = 0


Message = AskRows | AskColumns | AskImage | Run | Why | Change | PlayChampion


Plain = Mapping[str, Any]


def plain_message(text: str) -> Plain:
    """The object in a text; RefusedError where it is none."""
    try:
        plain = parsed(text, MAX_MESSAGE_BYTES)
    except ValueError as error:
        raise RefusedError(f"this is no JSON: {error}") from error
    if not isinstance(plain, dict):
        raise RefusedError("a message is an object")
    return plain


def message(plain: Plain) -> Message:
    """The message that an object is; RefusedError where it is none."""
    says = _kind(plain)
    if says is None:
        raise RefusedError(f"a message says one of: {', '.join(READERS)}")
    found = READERS[says](plain)
    if plain.keys() - KEYS[says] - {"say"}:
        raise RefusedError(f"{says} knows only: {', '.join(sorted(KEYS[says]))}")
    return found


def refusal(plain: Plain, why: str) -> dict[str, Any]:
    """What is said instead of an answer: to which kind of message, and to which question, where it has said so."""
    ask = plain.get("ask")
    return {"say": "refused", "why": why, "of": _kind(plain), "ask": ask if is_whole(ask, 0, MAX_NUMBER) else None}


def _kind(plain: Plain) -> str | None:
    says = plain.get("say")
    return says if isinstance(says, str) and says in READERS else None


def _rows(plain: Plain) -> AskRows:
    return AskRows(_fork(plain), *_span(plain))


def _columns(plain: Plain) -> AskColumns:
    columns = plain.get("columns")
    if not isinstance(columns, list) or not 0 < len(columns) <= MAX_COLUMNS:
        raise RefusedError(f"columns is a list of 1 to {MAX_COLUMNS}")
    return AskColumns(_fork(plain), tuple(map(_column, columns)), *_span(plain))


def _run(plain: Plain) -> Run:
    return Run(_fork(plain), _whole(plain, "to"))


def _why(plain: Plain) -> Why:
    return Why(_fork(plain), _whole(plain, "tick", 1), _whole(plain, "actuator"))


def _image(plain: Plain) -> AskImage:
    return AskImage(_fork(plain), _whole(plain, "tick"))


def _change(plain: Plain) -> Change:
    what, value = plain.get("what"), plain.get("value")
    if what not in REPLACED:
        raise RefusedError(f"what is one of: {', '.join(REPLACED)}")
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value <= 1:
        raise RefusedError("value is a number from 0 to 1")
    lasts = _whole(plain, "lasts", 1, default=1)
    return Change(_fork(plain), _whole(plain, "tick", 1), what, _column(plain.get("column")), float(value), lasts)


def _champion(plain: Plain) -> PlayChampion:
    seed = plain.get("seed")
    if seed is not None and not (isinstance(seed, str) and SEED.fullmatch(seed) and int(seed) <= MAX_SEED):
        raise RefusedError(f"seed is a whole number from 0 to {MAX_SEED}, as text")
    numbers = _whole(plain, "run"), _whole(plain, "attempt", 1), _whole(plain, "generation", 1)
    return PlayChampion(*numbers, None if seed is None else int(seed))


def _fork(plain: Plain) -> int:
    return _whole(plain, "fork", 0, MAX_FORKS, default=0)


def _span(plain: Plain) -> tuple[int, int, int, int]:
    """From, to, every and what is asked."""
    first, below = _whole(plain, "from"), _whole(plain, "to")
    return first, below, _whole(plain, "every", 1, default=1), _whole(plain, "ask", default=0)


def _column(plain: object) -> tuple[int, int]:
    match plain:
        case [int(block), int(index)] if is_whole(block, DOUBLE_BLOCK, SINGLE_BLOCK) and is_whole(index, 0, MAX_NUMBER):
            return block, index
    raise RefusedError("a column is a block, 0 or 1, and a number")


def _whole(plain: Plain, key: str, low: int = 0, high: int = MAX_NUMBER, default: int | None = None) -> int:
    value = plain.get(key, default)
    if not is_whole(value, low, high):
        raise RefusedError(f"{key} is a whole number from {low} to {high}")
    return int(value)


SPAN_KEYS = {"fork", "from", "to", "every", "ask"}
KEYS: Mapping[str, set[str]] = {
    "rows": SPAN_KEYS,
    "columns": SPAN_KEYS | {"columns"},
    "run": {"fork", "to"},
    "image": {"fork", "tick"},
    "why": {"fork", "tick", "actuator"},
    "change": {"fork", "tick", "what", "column", "value", "lasts"},
    "champion": {"run", "attempt", "generation", "seed"},
}
READERS: Mapping[str, Callable[[Plain], Message]] = {
    "rows": _rows,
    "columns": _columns,
    "run": _run,
    "image": _image,
    "why": _why,
    "change": _change,
    "champion": _champion,
}
