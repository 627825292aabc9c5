"""How many cases a test draws: a few in the suite that decides over a commit, all of them in `make test-slow`."""

from typing import Any

import pytest
from hypothesis import settings

EXPLORE = "explore"  # the profile of `make test-slow`
FEWER, LEAST = 5, 10  # so many times fewer of a test, and no fewer than this


def cases(count: int) -> int:
    """So many cases where new ones are explored, elsewhere fewer."""
    return count if settings.get_current_profile_name() == EXPLORE else min(count, max(LEAST, count // FEWER))


def first(few: int, values: Any) -> list[Any]:
    """So many values of a parameter, and the rest for `make test-slow`."""
    known = [*values]
    return [*known[:few], *(pytest.param(value, marks=pytest.mark.slow) for value in known[few:])]
