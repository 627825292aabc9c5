"""Work in threads that a program which ends does not wait for."""

from collections.abc import Callable, Sequence
from queue import SimpleQueue
from threading import Event, Thread
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")


def in_threads(work: Callable[[T], R], items: Sequence[T], stop: Event) -> list[R]:
    """What `work` makes of each item, each in a thread of its own, for which the caller's thread only waits.

    So Ctrl-C reaches it whatever compiled code does. `stop` is set where anything fails; of several errors the one of
    the first item is raised.
    """
    finished: SimpleQueue[tuple[int, R | BaseException]] = SimpleQueue()

    def run(number: int, item: T) -> None:
        try:
            result: R | BaseException = work(item)
        except BaseException as error:
            result = error
        finished.put((number, result))

    results: dict[int, R] = {}
    errors: dict[int, BaseException] = {}
    try:
        for number, item in enumerate(items):
            Thread(target=run, args=(number, item), daemon=True).start()
        while len(results) + len(errors) < len(items):
            number, result = finished.get()
            if isinstance(result, BaseException):
                errors[number] = result
                stop.set()
            else:
                results[number] = result
    except BaseException:
        stop.set()
        raise
    if errors:
        raise errors[min(errors)]
    return [results[number] for number in range(len(items))]
