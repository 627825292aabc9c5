"""Environments of Gymnasium: the numbers of their observations and actions, and the module that has one."""

from dataclasses import dataclass
from pathlib import Path

from mindrun.numbers.quantity import Span


@dataclass(frozen=True, slots=True)
class Slot:
    """The number with that `index` in a `part` of an observation or an action, which has no name where it is the whole.

    It is within `range`, None where the environment says that. An action that is one of several is the choice `chosen`.
    With `last` it is several numbers, from the one at `index` up to that, of the part flattened in C order.
    """

    part: str
    index: tuple[int, ...]
    range: Span | None = None
    chosen: int | None = None
    last: int | None = None

    def __str__(self) -> str:
        to = [] if self.last is None else ["to", f"{self.last}"]
        return " ".join([self.part, *map(str, self.index), *to]).strip()

    @property
    def has_two_ends(self) -> bool:
        """True if it has no range, or one from a number to a greater one."""
        return self.range is None or (self.range.by is None and self.range.first < self.range.last)


class OfEnvironment:
    """A sensor or an actuator: it may be a number of an environment's observation or action."""

    __slots__ = ()
    slot: Slot | None = None  # the number that it is; None outside of environments

    @property
    def is_outside(self) -> bool:
        """True if it belongs to an environment."""
        return self.slot is not None


def module_beside(name: str, folder: Path | None) -> Path | None:
    """The file of the module that an environment's name begins with, where it stands in a folder; nothing is run."""
    module, colon, _ = name.partition(":")
    if folder is None or not colon:
        return None
    top = folder / module.partition(".")[0]
    return next((path for path in (top.with_suffix(".py"), top / "__init__.py") if path.is_file()), None)
