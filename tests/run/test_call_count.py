"""Work that is counted, and bounded, in calls of functions."""

from contextlib import suppress

import pytest

from benchmarks.call_count import CallCount


def spin(times: float) -> None:
    done = 0
    while done < times:
        done += len("a")


def test_calls_of_python_and_of_c_are_counted() -> None:
    with CallCount() as calls:
        spin(10)
    assert 11 <= calls.number <= 13


def test_what_has_no_end_is_ended() -> None:
    with pytest.raises(AssertionError, match="1,001 calls of functions, more than 1,000"), CallCount(1000):
        spin(float("inf"))


def test_what_is_caught_is_said_at_the_end() -> None:
    with pytest.raises(AssertionError, match="more than 1,000"), CallCount(1000), suppress(AssertionError):
        spin(float("inf"))


def test_another_error_is_what_is_said() -> None:
    with pytest.raises(ZeroDivisionError), CallCount(1000):
        spin(1 / 0)
