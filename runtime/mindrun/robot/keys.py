"""Driving by the keys of a terminal: each counts for as long as what a hand says does, so one holds it down."""

import os
import sys
import termios
import tty
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress

from mindrun.robot.hand import Hand, Held

ARROWS = {b"\x1b[A": "w", b"\x1b[B": "s", b"\x1b[C": "d", b"\x1b[D": "a"}
WAYS = {"w": (1.0, 0.0), "s": (-1.0, 0.0), "a": (0.0, -0.5), "d": (0.0, 0.5), " ": (0.0, 0.0)}  # ahead, to the right
PAIRS = ("eq", "rf", "tg", "yh", "uj", "ik", "ol")  # more and less of all else that a hand holds, in its order
READ_BYTES = 64


def can_drive_by_keys() -> bool:
    """True if the standard input is a terminal, and this program in front of it."""
    with suppress(OSError):
        return bool(sys.stdin) and os.isatty(0) and os.tcgetpgrp(0) == os.getpgrp()
    return False


def level(held: Held, push: float) -> float:
    """The number for a push from −1 to 1: 0 is neutral, 1 the most, −1 the least."""
    push = min(1.0, max(-1.0, push))
    return held.neutral + push * (1.0 - held.neutral if push > 0 else held.neutral)


def pushed(held: Held, ahead: float, right: float, own: float) -> float:
    """The number that a hand says where it pushes so far ahead, to the right, and with the keys of this one alone."""
    match held.role:
        case "left":
            return level(held, ahead + right)
        case "right":
            return level(held, ahead - right)
        case "ahead":
            return level(held, ahead)
        case "turn":
            return level(held, 2 * right)  # half of it turns wheels well, and all of it is a lock of the steering
    return level(held, own)


class KeyDriving:
    """The numbers of a hand, pressed key by key. What is neither wheel, motor nor steering stays as it was pressed."""

    def __init__(self, hand: Hand) -> None:
        self._hand = hand
        others = [name for name, held in hand.held.items() if not held.role]
        self.pairs: Mapping[str, str] = dict(zip(others, PAIRS, strict=False))
        self._own = dict.fromkeys(hand.held, 0.0)

    def press(self, data: bytes) -> None:
        """Say what all keys in some bytes mean; others than those mean nothing."""
        for arrow, key in ARROWS.items():
            data = data.replace(arrow, key.encode())
        for key in data.decode("ascii", "ignore").lower():
            names = [name for name, pair in self.pairs.items() if key in pair]
            if not names and key not in WAYS:
                continue
            for name in names:
                self._own[name] = 1.0 if key == self.pairs[name][0] else -1.0
            if key == " ":
                self._own = dict.fromkeys(self._own, 0.0)
            for name, held in self._hand.held.items():
                self._hand.say(name, pushed(held, *WAYS.get(key, (0.0, 0.0)), self._own[name]))

    @property
    def help(self) -> str:
        """The keys, in a sentence."""
        moves = any(held.role for held in self._hand.held.values())
        parts = ["arrows or w a s d drive"] if moves else []
        parts += [f"{pair[0]} and {pair[1]} are {name}" for name, pair in self.pairs.items()]
        return "; ".join([*parts, "space: neutral", "a key counts for half a second: hold it"])


@contextmanager
def key_by_key() -> Iterator[None]:
    """Let the terminal give each key at once, and show none, as long as this lasts; Ctrl-C is what it is."""
    before = termios.tcgetattr(0)
    tty.setcbreak(0)
    try:
        yield
    finally:
        termios.tcsetattr(0, termios.TCSADRAIN, before)


def drive_by_keys(driving: KeyDriving, tell: Callable[[str], None]) -> None:
    """Read keys until the terminal is gone."""
    tell(driving.help)
    with suppress(OSError):
        while data := os.read(0, READ_BYTES):
            driving.press(data)
