"""Environments that are hostile, not only wrong: each ends in one sentence, and no program ends with it."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gymnasium")

import numpy as np
from gymnasium import spaces
from mindrun.errors import MindError
from mindrun.sim.outside import making

from mindlang.training.subject import open_subject
from tests.outside import hostile_worlds, minds, worlds
from tests.outside.hostile_worlds import ERRORS, Failing, named

GRAPH = minds.graph_of(minds.text())


def scored(world: str) -> Any:
    """What comes of two runs there."""
    rollout = minds.rollout_of(minds.text(scene=world))
    return rollout.score(minds.genomes(rollout, 1), [1, 2])


@pytest.mark.parametrize("error", ERRORS)
@pytest.mark.parametrize("place", ["make", "spaces", "reset", "step"])
def test_whatever_an_environment_raises_is_one_error_that_says_where(place: str, error: str) -> None:
    world = named(Failing, place=place, error=ERRORS[error])
    with pytest.raises(MindError, match=f"environment {world} ") as found:
        scored(world)
    said = {"exit": "SystemExit: 0", "exit-words": "SystemExit: bye", "base": "mine", "generator": "GeneratorExit"}
    assert said.get(error, type(ERRORS[error]).__name__) in found.value.hint


@pytest.mark.parametrize("error", ERRORS)
def test_whatever_it_raises_when_it_is_closed_is_of_no_use(error: str) -> None:
    good = scored(worlds.name(worlds.Line))
    found = scored(named(Failing, place="close", error=ERRORS[error]))
    np.testing.assert_array_equal(found.total, good.total)


def test_ctrl_c_in_an_environment_is_ctrl_c() -> None:
    world = named(Failing, place="make", error=KeyboardInterrupt())
    with pytest.raises(KeyboardInterrupt):
        making.make(world)


@pytest.mark.parametrize(
    "said", [np.array([1j, 2]), np.array(["1", "2"]), np.array([10**30, 1], object), [None, 1.0], [[1.0], [2.0, 3.0]]]
)
def test_what_is_no_real_number_is_no_observation(said: Any) -> None:
    world = named(hostile_worlds.Saying, said=said)
    with pytest.raises(MindError, match="failed") as found:
        scored(world)
    assert "the fault is the environment's: ValueError" in found.value.hint


def test_a_space_of_somebody_s_own_is_what_it_is_made_of() -> None:
    worlds.register()
    good = scored(worlds.name(worlds.Line))
    np.testing.assert_array_equal(scored(named(hostile_worlds.OwnBox)).total, good.total)


BOX = worlds.Line.action_space
NUMBERLESS = [
    spaces.Text(5), spaces.Sequence(BOX), spaces.Graph(BOX, None), spaces.OneOf([BOX, spaces.Discrete(2)]), None, 7,
]  # fmt: skip


@pytest.mark.parametrize("space", NUMBERLESS)
def test_a_space_without_numbers_is_refused_on_either_side(space: Any) -> None:
    for observed, acted in ((space, BOX), (worlds.INFINITE, space)):
        world = named(hostile_worlds.Odd, observed=observed, acted=acted)
        [found] = minds.compiled(minds.text("sensor place is observation 0 range 0 to 1", scene=world)).diagnostics
        assert "of the environment is no number" in found.message
        assert "Wrap the environment" in found.hint


@pytest.mark.parametrize(
    ("observed", "acted", "why"),
    [
        (spaces.Box(-1, 1, (3,)), BOX, "observes Box(-1.0, 1.0, (3,), float32), and the first Box(-inf, inf, (2,), "),
        (worlds.INFINITE, spaces.Box(-1.0, 3.0, (1,)), "takes Box(-1.0, 3.0, (1,), float32), and the first Box(-1.0, "),
        (worlds.INFINITE, spaces.Discrete(2), "takes Discrete(2), and the first Box"),
        (spaces.Dict({"a": worlds.INFINITE}), BOX, "observes Dict('a': Box(-inf, inf, (2,), float64)), and the first "),
    ],
)  # fmt: skip
def test_spaces_that_are_others_when_it_is_made_again_are_one_error(observed: Any, acted: Any, why: str) -> None:
    world, hostile_worlds.Changing.made = named(hostile_worlds.Changing, observed=observed, acted=acted), -1
    with pytest.raises(MindError, match="has other spaces each time that it is made") as found:
        scored(world)
    assert f"In the beginning of the run of seed 1 it {why}" in found.value.hint


MODULE = "import gymnasium\nfrom tests.outside.worlds import Line\ngymnasium.register('NAME/Mine-v0', Line)\n"


def beside(folder: Path, module: str, text: str = MODULE) -> str:
    """A module beside a mind; the name of its environment."""
    folder.mkdir(exist_ok=True)
    (folder / f"{module}.py").write_text(text.replace("NAME", module))
    return f"{module}:{module}/Mine-v0"


def test_two_modules_of_one_name_are_not_taken_for_each_other(tmp_path: Path) -> None:
    world = beside(tmp_path / "a", "twice_here")
    assert beside(tmp_path / "b", "twice_here") == world
    making.make(world, tmp_path / "a")
    with pytest.raises(MindError, match="cannot be made") as found:
        making.make(world, tmp_path / "b")
    assert f"another module called twice_here here ({tmp_path / 'a' / 'twice_here.py'})" in found.value.hint
    with pytest.raises(MindError) as found:
        making.make(beside(tmp_path / "c", "json"), tmp_path / "c")
    assert "another module called json here" in found.value.hint


def test_a_module_that_has_changed_since_it_was_imported_is_not_run_as_it_was(tmp_path: Path) -> None:
    world = beside(tmp_path, "changed_here")
    making.make(world, tmp_path)
    beside(tmp_path, "changed_here", f"{MODULE}\n# another\n")
    with pytest.raises(MindError) as found:
        making.make(world, tmp_path)
    assert (
        found.value.hint == "changed_here.py has changed since this program has imported it: begin the program again."
    )


def test_a_run_does_not_go_on_in_another_text_of_its_module(tmp_path: Path) -> None:
    from datetime import UTC, datetime

    from mindlang.compiler.compile import load
    from mindlang.training.subject import begin_run, refuse_changed

    world, file = beside(tmp_path, "resumed_here"), tmp_path / "go.mind"
    file.write_text(
        minds.text(scene=world) + "curriculum School is genetic population 4\n  teaches Go on Go for 2 generations\n"
    )
    subject = open_subject(file, load(file))
    [lesson] = subject.graph.lessons

    def begun() -> Any:
        return begin_run(subject, lesson, 1, tmp_path / "runs", datetime.now(UTC), ["mindc"])

    before = begun()
    assert begun().manifest.identity == before.manifest.identity
    refuse_changed(subject, before)
    beside(tmp_path, "resumed_here", f"{MODULE}\n# of another gravity\n")
    assert begun().manifest.identity != before.manifest.identity
    with pytest.raises(MindError, match="has changed since this run of Go began"):
        refuse_changed(subject, before)


@pytest.mark.parametrize("command", ["run", "bench"])
def test_what_code_in_c_prints_is_not_in_the_document(tmp_path: Path, command: str) -> None:
    text = minds.text(scene="loud_here:loud_here/Mine-v0").replace("is mlp hidden 1", "is rule")
    (tmp_path / "go.mind").write_text(text.replace("drives push", "drives push at place"))
    beside(tmp_path, "loud_here", MODULE.replace("worlds import Line", "hostile_worlds import Loud as Line"))
    more = ["--runs", "2"] if command == "bench" else []
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            "from mindlang.cli import main; main()",
            command,
            f"{tmp_path}/go.mind",
            "--json",
            *more,
        ],
        cwd=Path(__file__).parents[2],
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)
    if command != "bench":  # whose processes say it where nobody reads
        assert "step from C" in done.stderr
        assert "kept back by C" in done.stderr
