"""What cannot be done from Python is one MindError, with what to do about it."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mindlang
from mindlang import Mind, MindError
from tests.api.conftest import COLLECT


@pytest.mark.parametrize(
    ("path", "message", "hint"),
    [
        ("none.mind", "cannot be read: No such file", "Is the path right?"),
        ("none/at/all.mind", "cannot be read: No such file", "Is the path right?"),
        (".", "is a folder: name the files in it", "A .mind file is UTF-8 text"),
    ],
)
def test_what_is_no_file_is_a_mind_with_a_diagnostic(path: str, message: str, hint: str, tmp_path: Path) -> None:
    mind = mindlang.load(tmp_path / path)
    assert [each.code for each in mind.diagnostics] == ["unreadable"]
    with pytest.raises(MindError, match=message) as caught:
        mind.engine()
    assert caught.value.hint.startswith(hint)


def test_a_file_that_is_called_nearly_so_is_named(tmp_path: Path) -> None:
    for name in ("rover.mind", "rover.lock", "other.mind"):
        (tmp_path / name).touch()
    (found,) = mindlang.load(tmp_path / "rovr.mnd").diagnostics
    assert found.hint == f"Did you mean {tmp_path / 'rover.mind'}?"


@pytest.mark.parametrize(
    "ask", ["graph", "policy", "engine", "rollout", "trace", "trace_table", "bench", "train", "edit", "bundle"]
)
def test_a_text_with_errors_is_a_mind_that_can_do_nothing(ask: str) -> None:
    wrong = mindlang.loads("tick 1/60 s\nmaster Nobody\n")
    assert not wrong.is_valid
    assert {each.code for each in wrong.diagnostics} == {"no-body", "unknown-skill"}
    with pytest.raises(MindError) as caught:
        getattr(wrong, ask)(*["rename"] * (ask == "edit"))
    assert str(caught.value) in {each.message for each in wrong.diagnostics}
    assert caught.value.hint


UNKNOWN: dict[str, tuple[Callable[[Mind], object], str]] = {
    "there is no task called Colect": (lambda mind: mind.rollout("Colect"), "Did you mean Collect?"),
    "there is no task called Colec": (lambda mind: mind.bench("Colec"), "Did you mean Collect?"),
    "there is no skill called Avoit": (lambda mind: mind.engine("Avoit"), "Did you mean Avoid?"),
    "there is no skill called Avid": (lambda mind: mind.rollout("Collect", "Avid"), "Did you mean Avoid?"),
    "there is no skill called Avodi": (lambda mind: mind.rollout(learners=["Avodi"]), "Did you mean Avoid?"),
    "there is no edit called renam": (lambda mind: mind.edit("renam"), "Did you mean rename?"),
    "no lesson teaches Avid": (lambda mind: mind.train("Avid"), "Did you mean Avoid?"),
    "there is no curriculum called Nothing": (lambda mind: mind.train(curriculum="Nothing"), "There is"),
    "Nothing is called proximty": (
        lambda mind: mind.edit("rename", old="proximty", new="whiskers"),
        "Did you mean proximity?",
    ),
}


@pytest.mark.parametrize("message", UNKNOWN)
def test_a_name_that_is_none(message: str) -> None:
    ask, hint = UNKNOWN[message]
    with pytest.raises(MindError, match=message) as caught:
        ask(mindlang.load(COLLECT / "collect.mind"))
    assert caught.value.hint.startswith(hint)


def test_a_text_is_not_taught() -> None:
    text = (COLLECT / "collect.mind").read_text()
    with pytest.raises(MindError, match="is no file") as caught:
        mindlang.loads(text).train("Avoid")
    assert "save it" in caught.value.hint


def test_a_frozen_skill_is_not_taught(collect: Path) -> None:
    mind = mindlang.load(collect / "collect.mind").edit("freeze", skill="Avoid").write()
    with pytest.raises(MindError, match="Avoid is frozen") as caught:
        mind.train("Avoid")
    assert "unfreeze" in caught.value.hint


COUNTED: dict[str, Callable[[Mind, Any], object]] = {
    "train seed": lambda mind, value: mind.train("Avoid", seed=value),
    "train workers": lambda mind, value: mind.train("Avoid", workers=value),
    "bench runs": lambda mind, value: mind.bench("Avoid", runs=value),
    "bench seed": lambda mind, value: mind.bench("Avoid", seed=value),
    "bench workers": lambda mind, value: mind.bench("Avoid", workers=value),
    "trace seed": lambda mind, value: mind.trace("Avoid", seed=value),
    "table seed": lambda mind, value: mind.trace_table("Avoid", seed=value),
    "rollout workers": lambda mind, value: mind.rollout("Avoid", learners=["Avoid"], workers=value),
    "generations": lambda mind, value: mindlang.TrainOptions(generations=value),
    "population": lambda mind, value: mindlang.TrainOptions(population=value),
    "attempts": lambda mind, value: mindlang.TrainOptions(attempts=value),
    "rungs": lambda mind, value: mindlang.TrainOptions(rungs=value),
}


@pytest.mark.parametrize("value", [-1, 2**64, 1.5, "3", True, float("nan")])
@pytest.mark.parametrize("case", COUNTED)
def test_a_number_is_whole_and_within_its_bounds(case: str, value: Any) -> None:
    with pytest.raises(MindError, match="cannot be") as caught:
        COUNTED[case](mindlang.load(COLLECT / "collect.mind"), value)
    assert "is a whole number from" in caught.value.hint


def test_numbers_of_numpy_are_numbers() -> None:
    options = mindlang.TrainOptions(generations=np.int64(3))  # type: ignore[arg-type]
    assert (options.generations, type(options.generations)) == (3, int)


@pytest.mark.parametrize("scale", [0, -1.0, float("nan"), float("inf"), 1001])
def test_a_scale_is_within_its_bounds(scale: float) -> None:
    with pytest.raises(MindError, match="scale cannot be"):
        mindlang.TrainOptions(scale=scale)
