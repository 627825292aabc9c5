"""What a job has taken, beside what came of it: seconds, and how often its sensors were read beyond their ranges."""

from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.files.strict_json import is_whole
from mindrun.work.frame import Frame, FrameError

MAX_SECONDS, MAX_COUNT = 1e9, 2**53

Tally = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Effort:
    """The seconds of a job, and what its scorer has counted meanwhile."""

    seconds: float
    tally: Tally

    @property
    def about(self) -> dict[str, Any]:
        """What an answer says of it."""
        return {"seconds": float(self.seconds), "tally": self.tally.tolist()}

    def count_in(self, scorer: Any) -> None:
        """Add what was counted elsewhere to what a scorer has counted."""
        if len(self.tally):
            scorer.add(self.tally)


def tally_of(scorer: Any) -> Tally:
    """What a scorer has counted beside its results, as `mindrun.sim.outside.rollout` does; others count nothing."""
    return scorer.tally() if hasattr(scorer, "tally") else np.zeros(0, np.int64)


def effort_of(answer: Frame, scorer: Any) -> Effort:
    """What an answer says of it; FrameError where that is not of such a scorer."""
    match answer.about:
        case {"seconds": float(seconds), "tally": [*found]} if (
            isfinite(seconds)
            and 0 <= seconds <= MAX_SECONDS
            and len(found) == len(tally_of(scorer))
            and all(is_whole(n, 0, MAX_COUNT) for n in found)
        ):
            return Effort(seconds, np.array(found, np.int64))
    raise FrameError("it does not say what its job has taken")
