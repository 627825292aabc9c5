"""The messages that the page sends, and texts as it may show them.

Messages are JSON objects told apart by `say`, decoded by msgspec: bounds and unknown keys are part of its types.
Numbers of rows go into the header of a frame, which has 32 bits for each.
"""

from typing import Annotated, Any, ClassVar, Literal

import msgspec
from mindrun.engine.changes import What
from mindrun.errors import MindError
from mindrun.files.printable import visible
from msgspec import Meta, Struct, field

MAX_MESSAGE_BYTES = 16 << 10
MAX_COLUMNS = 64  # that are asked for at once
MAX_FORKS = 16
MAX_SEED = (1 << 64) - 1
SHOWN_CHARACTERS = 200

Whole = Annotated[int, Meta(ge=0, le=(1 << 32) - 1)]
Counted = Annotated[int, Meta(ge=1, le=(1 << 32) - 1)]
ForkNumber = Annotated[int, Meta(ge=0, le=MAX_FORKS)]
Seed = Annotated[str, Meta(pattern="^[0-9]{1,20}$")]  # JavaScript has no whole numbers of 64 bits
Column = tuple[Literal[0, 1], Whole]  # its block, its number there


class RefusedError(ValueError):
    """A question that cannot be answered; its text is shown to whoever asked."""


class _PageMessage(Struct, tag_field="say", frozen=True, forbid_unknown_fields=True):
    """A message of the page."""


class _RunMessage(_PageMessage, frozen=True, kw_only=True):
    """A message about the run that is shown, or a fork of it."""

    fork: ForkNumber = 0


class _AskTicks(_RunMessage, frozen=True, kw_only=True):
    """Ticks `first`, `first` + `every` … below `below`."""

    first: Whole = field(name="from")
    below: Whole = field(name="to")
    every: Counted = 1
    ask: Whole = 0


class AskRows(_AskTicks, tag="rows", frozen=True):
    """Asks for all columns of ticks."""


class AskColumns(_AskTicks, tag="columns", frozen=True, kw_only=True):
    """Asks for some columns of ticks."""

    columns: Annotated[tuple[Column, ...], Meta(min_length=1, max_length=MAX_COLUMNS)]


class AskRun(_RunMessage, tag="run", frozen=True):
    """Asks to let a run go on to a tick."""

    to: Whole


class AskShares(_RunMessage, tag="why", frozen=True):
    """Asks for the shares of all paths in an actuator's command of a tick."""

    tick: Counted
    actuator: Whole


class AskImage(_RunMessage, tag="image", frozen=True):
    """Asks for the environment's own image after a tick."""

    tick: Whole


class AskChange(_RunMessage, tag="change", frozen=True):
    """Asks for a fork of the run in which a value is replaced from `tick` on, for `lasts` ticks."""

    tick: Counted
    what: What
    column: Column
    value: Annotated[float, Meta(ge=0, le=1)]
    lasts: Counted = 1


def _refuse_no_seed(seed: str | None) -> None:
    if seed is not None and int(seed) > MAX_SEED:
        raise ValueError(f"seed is a whole number from 0 to {MAX_SEED}, as text")


class PlayChampion(_PageMessage, tag="champion", frozen=True):
    """Asks to show the champion of a generation of a training instead; `seed` None keeps the world."""

    run: Whole
    attempt: Counted
    generation: Counted
    seed: Seed | None = None

    fork: ClassVar[int] = 0

    def __post_init__(self) -> None:
        """Refuse a seed that no run has."""
        _refuse_no_seed(self.seed)


class SayOrder(_PageMessage, tag="order", frozen=True):
    """Says an order to the robot that drives."""

    name: Annotated[str, Meta(max_length=SHOWN_CHARACTERS)]
    value: float

    fork: ClassVar[int] = 0


class SayHand(_PageMessage, tag="drive", frozen=True):
    """Says the numbers of all that a hand holds, in their order."""

    values: Annotated[tuple[Annotated[float, Meta(ge=0, le=1)], ...], Meta(min_length=1, max_length=MAX_COLUMNS)]

    fork: ClassVar[int] = 0


class PlaySeed(_PageMessage, tag="layout", frozen=True):
    """Asks to drive in another layout: that of a seed, or one that is drawn."""

    seed: Seed | None = None

    fork: ClassVar[int] = 0

    def __post_init__(self) -> None:
        """Refuse a seed that no run has."""
        _refuse_no_seed(self.seed)


class WatchRobot(_PageMessage, tag="watch", frozen=True):
    """Asks to see the run through another robot of its world, by its number."""

    robot: Whole

    fork: ClassVar[int] = 0


Message = (
    AskRows
    | AskColumns
    | AskImage
    | AskRun
    | AskShares
    | AskChange
    | PlayChampion
    | SayOrder
    | SayHand
    | PlaySeed
    | WatchRobot
)
_DECODER: msgspec.json.Decoder[Message] = msgspec.json.Decoder(Message)


def message(text: str | bytes) -> Message:
    """The message that a text is; RefusedError where it is none."""
    try:
        return _DECODER.decode(text)
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        raise RefusedError(f"this is no message: {error}") from error


class _Question(Struct):
    """The kind of a message, whatever else is wrong with it, and the number of its question, where it has one."""

    say: str | None = None
    ask: Whole | None = None


def refusal(text: str | bytes, why: str) -> dict[str, Any]:
    """The message that refuses another one, for the reason `why`."""
    try:
        of = msgspec.json.decode(text, type=_Question)
    except (msgspec.DecodeError, RecursionError, UnicodeError):
        of = _Question()
    return {"say": "refused", "why": why, "of": of.say, "ask": of.ask}


def shown(text: str) -> str:
    """The text with control and direction characters spelt out, and no longer than a page can show."""
    spelt = visible(text[: SHOWN_CHARACTERS + 1])
    return spelt if len(spelt) <= SHOWN_CHARACTERS else spelt[: SHOWN_CHARACTERS - 1] + "…"


def error_text(error: MindError) -> str:
    """An error's message and its hint as one line, safe to show."""
    return shown("; ".join(filter(None, (str(error), error.hint))))
