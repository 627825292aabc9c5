"""In a notebook each public value is one short line, however much is in it."""

from pathlib import Path
from typing import Any

import mindrun
import pytest
from mindrun.numbers.short_repr import MOST_CHARACTERS, full_repr
from mindrun.train.lesson_state import Record

import mindlang


def values(rules: Path) -> list[Any]:
    """One value of each public type, and others that are had from them."""
    mind = mindlang.load(rules)
    wrong = mindlang.loads("mind 1\n" + "sensor x is nothing\n" * 99)
    trace = mind.trace("Roam", 3)
    rollout = mind.rollout("Roam")
    edited = mind.edit("rename", old="feeler", new="whisker")
    several: list[Any] = [mind, wrong, mind.compiled, wrong.diagnostics[0], wrong.diagnostics[0].span, edited]
    several += [mind.graph, mind.policy(), mind.engine(), mind.bundle(), rollout, trace, next(trace.moments)]
    several += [rollout.score([[]], [1, 2]), mindlang.TrainOptions(), mindrun.Replayed(3, (2, "left is 1"))]
    return [*several, Record(1, 1, 0.5, 0.25, None, None, 10, 0.5, 0), mindlang.MindError("no", "because")]


def test_every_public_value_is_a_line(rules: Path) -> None:
    found = values(rules)
    public = {getattr(module, name) for module in (mindlang, mindrun) for name in module.__all__}
    missing = {each for each in public if isinstance(each, type)} - {type(each) for each in found}
    assert not missing, f"add a value of {missing}"
    for each in found:
        line = repr(each)
        assert len(line) <= MOST_CHARACTERS, line
        assert "\n" not in line


def test_it_says_what_is_in_it(rules: Path) -> None:
    graph = mindlang.load(rules).graph
    assert repr(graph).startswith("Graph(tick=0.01")
    assert f"sensors=[{len(graph.sensors)}]" in repr(graph)
    assert "Chase" in full_repr(graph)


@pytest.mark.parametrize("text", ["x" * 999, "\n\n'\""])
def test_texts_are_cut_and_stay_in_the_line(text: str) -> None:
    assert len(repr(mindlang.loads("mind 1\n", name=text)).splitlines()) == 1
