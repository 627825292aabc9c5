"""Cleans up in forked children: a procedure that forks must not make a second controller."""

import os
from collections.abc import Callable

_let_go: set[Callable[[], None]] = set()


def keep_from_children(let_go: Callable[[], None]) -> None:
    """Call this in every process that is forked from now on, and do not in this one."""
    _let_go.add(let_go)


def keep_no_longer(let_go: Callable[[], None]) -> None:
    """No longer call this in forked processes: the resource has been released."""
    _let_go.discard(let_go)


def _in_child() -> None:
    while _let_go:
        _let_go.pop()()


os.register_at_fork(after_in_child=_in_child)
