"""What reward lines have paid, added up: always in the order of the source, so that all come to the same bits."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Reward

Floats = NDArray[np.float64]


def score_of(paid: Floats) -> Any:
    """The sums [...] of what all lines have paid [..., lines]."""
    found = np.zeros(paid.shape[:-1])
    for line in range(paid.shape[-1]):
        found = found + paid[..., line]
    return found


def paid_by_text(rewards: Sequence[Reward], paid: Floats) -> dict[str, Any]:
    """What the lines of each text have paid together [...], of what each has paid [..., lines]."""
    found: dict[str, Any] = {}
    for line, reward in enumerate(rewards):
        found[reward.text] = found.get(reward.text, 0.0) + paid[..., line]
    return found
