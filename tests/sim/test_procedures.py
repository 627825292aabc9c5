"""A procedure gives the same run compiled, in Python between the stages, and as the rule that says the same."""

import ast
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.errors import ProcedureError
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.minds import DRIFTER, compile_text

WORLD = """
task Drift in arena size 40
  contains object is item size 1
  contains rock is obstacle grid 10 size 2 to 4 jitter 1
  lasts 300 ticks
  rewards progress toward object per tick
"""
WHEELS = "def wheels(slow, quick, odd, ahead):\n    return 0.25 + slow * 0.7, 0.95 - slow * 0.6, 0.2 + quick\n"
# A dictionary of lists is beyond numba.
SLOW = "SEEN = {}\n\n\ndef wheels(*given):\n    SEEN.setdefault('n', []).append(1)\n    SEEN['n'].clear()\n"
SLOW += "    slow, quick, odd, ahead = given\n    return [0.25 + slow * 0.7, 0.95 - slow * 0.6, 0.2 + quick]\n"


def run(text: str, folder: Path | None) -> tuple[Rollout, np.ndarray]:
    rollout = Rollout(Policy(compile_text(text), {}), "Drift", "Drift", procedures=folder, interrupt=False)
    return rollout, np.array([np.concatenate([m.body, m.commands]) for m in trace(rollout, 5).moments])


def mind(module: str) -> str:
    lines = [line for line in DRIFTER.splitlines() if "drives" not in line]
    text = "\n".join(lines).replace("skill Drift is rule", f"skill Drift is procedure from {module}.wheels")
    return text + "\n  drives left_wheel\n  drives right_wheel\n  drives claw\n" + WORLD


def test_compiled_slow_and_rule_agree(tmp_path: Path) -> None:
    (tmp_path / "quick.py").write_text(WHEELS)
    (tmp_path / "slow.py").write_text(SLOW)
    lines = [line for line in DRIFTER.splitlines() if "drives" not in line]
    rule = "\n".join(lines) + "\n  drives left_wheel at 0.25 + slow * 0.7\n  drives right_wheel at 0.95 - slow * 0.6\n"
    as_rule, expected = run(rule + "  drives claw at 0.2 + quick\n" + WORLD, None)
    quick, compiled = run(mind("quick"), tmp_path)
    slow, python = run(mind("slow"), tmp_path)
    assert not as_rule.procedures.slow
    assert not quick.procedures.slow
    assert "Drift" in slow.procedures.slow
    assert len(expected) == 300
    assert np.array_equal(expected, compiled)
    assert np.array_equal(expected, python)


def test_slow_procedures_score_like_compiled_ones_in_many_lanes(tmp_path: Path) -> None:
    (tmp_path / "quick.py").write_text(WHEELS)
    (tmp_path / "slow.py").write_text(SLOW)
    none = np.zeros((1, 0), np.float32)
    scores = [
        Rollout(Policy(compile_text(mind(name)), {}), "Drift", "Drift", procedures=tmp_path, workers=2, lanes=3).score(
            none, range(7)
        )
        for name in ("quick", "slow")
    ]
    assert len(np.unique(scores[0].total)) == 7
    assert np.array_equal(scores[0].total, scores[1].total)


TALK = "def wheels(slow, quick, odd, ahead):\n    {}\n    return 0.25 + slow * 0.7, 0.95 - slow * 0.6, 0.2 + quick\n"
FAILING = {
    "raises": "if slow < 0.5: raise ValueError('no')",
    "asserts": "assert slow >= 0.5",
    "divides": "slow = 1 / (slow < 0.5)",
    "domain": "import math; slow = math.sqrt(slow - 0.5)",
    "index": "slow = (slow, quick)[int(slow * 1000)]",
    "slow": "if [slow][0] < 0.5: raise ValueError('no')",
    "leaves": "if [slow][0] < 0.5: raise GeneratorExit('no')",
}


@pytest.mark.parametrize("name", FAILING)
def test_what_fails_ends_the_run_as_it_does_on_the_robot(tmp_path: Path, name: str) -> None:
    (tmp_path / "fails.py").write_text(TALK.format(FAILING[name]))
    graph = compile_text(mind("fails"))
    source, failed = TALK.format(FAILING[name]), r"procedure fails.wheels fails for \[.*\] in fails.py, line 2: "
    for workers, lanes in [(1, 16), (3, 2)]:
        rollout = Rollout(Policy(graph, {}), "Drift", "Drift", procedures=tmp_path, workers=workers, lanes=lanes)
        with pytest.raises(ProcedureError, match=failed) as error:
            rollout.score(np.zeros((1, 0), np.float32), range(20))
        given = np.array(ast.literal_eval(str(error.value).split("for ")[1].split(" in fails")[0]), np.float32)
        with pytest.raises(ProcedureError) as there:
            graph.skills[0].function.ready(4, 3, np.zeros(0, np.float32), {"fails": source})(given)
        assert str(there.value) == str(error.value)


REMEMBERS = "SEEN = []\n\n\n" + TALK.format("SEEN.append(slow); slow = sum(SEEN) / len(SEEN)")
DRAWS = "import random\nDICE = random.Random(7)\n\n\n" + TALK.format("slow = DICE.random()")


@pytest.mark.parametrize("source", [REMEMBERS, DRAWS])
def test_what_a_procedure_remembers_is_of_its_run(tmp_path: Path, source: str) -> None:
    (tmp_path / "own.py").write_text(source)
    graph, none = compile_text(mind("own")), np.zeros((1, 0), np.float32)
    found = [
        Rollout(Policy(graph, {}), "Drift", "Drift", procedures=tmp_path, workers=workers, lanes=lanes).score(
            none, range(9)
        )
        for workers, lanes in [(1, 1), (1, 4), (2, 3)]
    ]
    assert len(np.unique(found[0].total)) == 9
    for other in found[1:]:
        assert np.array_equal(found[0].total, other.total)


def test_a_procedure_without_outputs_is_never_called(tmp_path: Path) -> None:
    (tmp_path / "idle.py").write_text("def wheels(*given):\n    raise ValueError\n")
    graph = compile_text(mind("idle"))
    edges = tuple(replace(edge, output=None, value=(("number", 0.5),)) for edge in graph.skills[0].edges)
    graph = replace(graph, skills=(replace(graph.skills[0], edges=edges),))
    rollout = Rollout(Policy(graph, {}), "Drift", "Drift", procedures=tmp_path)
    assert rollout.score(np.zeros((1, 0), np.float32), [1]).ticks[0, 0] > 0
