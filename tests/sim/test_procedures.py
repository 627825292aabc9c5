"""A procedure gives the same run compiled, in Python between the stages, and as the rule that says the same."""

from pathlib import Path

import numpy as np
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
    rollout = Rollout(compile_text(text), {}, "Drift", "Drift", procedures=folder, interrupt=False)
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
        Rollout(compile_text(mind(name)), {}, "Drift", "Drift", procedures=tmp_path, workers=2, lanes=3).score(
            none, range(7)
        )
        for name in ("quick", "slow")
    ]
    assert len(np.unique(scores[0].total)) == 7
    assert np.array_equal(scores[0].total, scores[1].total)
