"""What a check has seen: whether that is as it should be, and what mends it."""

from dataclasses import dataclass
from enum import Enum


class State(Enum):
    """How something is; what is absent is no fault, and needed only for what is said of it."""

    FINE = "ok"
    ABSENT = "absent"
    WRONG = "wrong"


@dataclass(frozen=True, slots=True)
class Finding:
    """What was looked at, how it is, what was seen, and the line that mends it, where it is not fine."""

    what: str
    state: State
    seen: str
    mend: str = ""
