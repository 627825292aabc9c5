"""What should be known of many runs is in what they came to, as the command prints it."""

from pathlib import Path

import pytest

pytest.importorskip("gymnasium")

import mindlang
from tests.outside import worlds
from tests.outside.test_commands import RULES, rules


def test_readings_beyond_their_range_are_noted(tmp_path: Path) -> None:
    worlds.register()
    text = RULES.replace("range -3 to 3", "range -0.2 to 0.2")
    (note,) = mindlang.load(rules(tmp_path, text=text)).bench(runs=3)["notes"]
    assert note.startswith("readings beyond their range: place in ")
    assert note.endswith("% of the ticks")
    assert mindlang.load(rules(tmp_path, text=RULES.replace("-3 to 3", "-99 to 99"))).bench(runs=3)["notes"] == []
