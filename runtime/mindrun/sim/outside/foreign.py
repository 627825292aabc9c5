"""Code of somebody else: it may raise what it likes, and does not end this program."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

GAVE_NO_NUMBER = "gave what is no number"  # what is said of an environment where its own observation or reward is NaN


@contextmanager
def foreign_code() -> Iterator[None]:
    """Around such code: what it raises is an `Exception`, sys.exit too. Ctrl-C stays what it is.

    A child that it has forked, and that comes back to here, ends as it was to.
    """
    process = os.getpid()
    try:
        yield
    except (Exception, KeyboardInterrupt):
        raise
    except BaseException as error:
        if os.getpid() != process:
            raise
        raise RuntimeError(first_line(error)) from error


def first_line(error: BaseException) -> str:
    """What an error of somebody else's code says, short enough for one line."""
    try:
        lines = str(error).splitlines()
    except Exception:  # it is somebody else's code that says it
        lines = []
    said = next((line.strip() for line in lines if line.strip()), "")
    return f"{type(error).__name__}: {said}"[:200] if said else type(error).__name__
