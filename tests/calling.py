"""Calling mindc inside the test's own process, and the small mind that most calls are about."""

import random
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from mindlang import cli
from mindlang.cli import _terminal as terminal

RULES = """tick 1/60 s
master Roam
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor ball_bearing is bearing of ball
sensor feeler is range_finder at 0 30 330 deg

skill Chase is rule
  reads ball_bearing
  drives left_wheel at 3 * ball_bearing - 0.7
  drives right_wheel at 2.3 - 3 * ball_bearing

skill Turn is rule
  drives left_wheel at 0.9
  drives right_wheel at 0.1

skill Roam is rule
  reads feeler
  influences Chase at 1
  influences Turn at 0.2

task Chase in plain
  contains ball is item size 2 reached moves
  lasts 1200 ticks
  rewards 10 on reach of ball
  rewards 0.001 * progress toward ball per tick
  counts reach of ball

task Roam in arena size 40
  contains rock is obstacle grid 10 size 2 to 3
  contains ball is item size 2 reached moves
  lasts 600 ticks
  ends on collision
  rewards -5 on collision
  rewards 0.001 * progress toward ball per tick
  counts reach of ball
"""


class Said(NamedTuple):
    """How a command ended, and what it printed."""

    code: int
    out: str
    err: str


Call = Callable[..., Said]


def caller(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    """A function that calls mindc with its arguments. What it draws at random is the same whenever a test runs."""
    monkeypatch.setattr("secrets.randbits", random.Random(1).getrandbits)  # the seed of whoever gives none

    def call(*arguments: object) -> Said:
        terminal.console.cache_clear()
        monkeypatch.setattr(sys, "argv", ["mindc", *map(str, arguments)])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        terminal.console.cache_clear()
        said = capsys.readouterr()
        assert isinstance(stop.value.code, int)
        return Said(stop.value.code, said.out, said.err)

    return call


def write_rules(folder: Path) -> Path:
    """The small mind as a file."""
    path = folder / "rules.mind"
    path.write_text(RULES, encoding="utf-8")
    return path
