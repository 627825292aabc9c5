"""What is said of procedures from their text: by check and build, before anything runs."""

from pathlib import Path

import pytest
from mindrun.errors import ProcedureError
from mindrun.procedure_text import fit

from tests.calling import RULES, Call

CALLING = RULES.replace("skill Turn is rule", "skill Turn is procedure from turning.turn\n  reads feeler").replace(
    "  drives left_wheel at 0.9\n  drives right_wheel at 0.1\n", "  drives left_wheel\n  drives right_wheel\n"
)
RIGHT = "def turn(left, ahead, right):\n    return 0.9, 0.1\n"
WRONG = {
    "def turn(left: return": "SyntaxError",
    "return 1": "'return' outside function",
    "def turns(a, b, c): return 1, 2": "its module has no such function",
    "def turn(feeler): return 1, 2": "takes 1 number, and the skill reads 3 (turning.py, line 1)",
    "def turn(a, b, c, d, e=1): return 1, 2": "takes 4 to 5 numbers",
    "def turn(a, b, c): return 1, 2, 3": "returns 3 values, and the skill needs 2",
    "def turn(a, b, c): print(a)": "returns 0 values",
    "async def turn(a, b, c): return 1, 2": "is async",
    "def turn(a, b, c): yield 1": "yields",
    "import rules\ndef turn(a, b, c): return 1, 2": "imports rules, a file that no bundle holds (turning.py, line 1)",
    "from . import x\ndef turn(a, b, c): return 1, 2": "imports ., a file",
    "import random\ndef turn(a, b, c): return random.random(), 2": "draws from random.random",
    "from numpy.random import rand as r\ndef turn(a, b, c): return r(), 2": "draws from numpy.random.rand",
    "import numpy as np\ndef turn(a, b, c): return np.random.default_rng().random(), 2": "default_rng without a seed",
    "x = " + "(" * 1000 + ")" * 1000: "",
    "\0": "",
}
FINE = (
    RIGHT,
    "\ufeff" + RIGHT,
    "turn = lambda *given: (1, 2)",
    "from math import *\nfrom os.path import *",
    "def turn(*given): return list(given)[:2]",
    "import random\nDICE = random.Random(3)\ndef turn(a, b, c): return DICE.random(), 1",
    "if True:\n    def turn(a, b, c): return 1, 2\nelse:\n    def turn(a): return 1",
    "def turn(a, b, c):\n    def inner(): return 1, 2, 3\n    return inner()[:2]",
)


@pytest.mark.parametrize("source", WRONG)
def test_check_and_build_say_what_is_wrong(mindc: Call, tmp_path: Path, source: str) -> None:
    (tmp_path / "calling.mind").write_text(CALLING)
    (tmp_path / "rules.py").touch()
    (tmp_path / "turning.py").write_text(source)
    checked = mindc("check", tmp_path / "calling.mind")
    built = mindc("build", tmp_path / "calling.mind", "-o", tmp_path / "x.bundle", "--master", "Turn")
    for said in (checked, built):
        assert said.code == 1
        assert "[faulty-procedure]" in said.err
        assert WRONG[source] in said.err
    assert not (tmp_path / "x.bundle").exists()


@pytest.mark.parametrize("source", FINE)
def test_nothing_is_said_of_what_may_be_right(mindc: Call, tmp_path: Path, source: str) -> None:
    (tmp_path / "calling.mind").write_text(CALLING)
    (tmp_path / "turning.py").write_text(source, encoding="utf-8")
    assert mindc("check", tmp_path / "calling.mind").code == 0


def test_nothing_is_run(mindc: Call, tmp_path: Path) -> None:
    (tmp_path / "calling.mind").write_text(CALLING)
    (tmp_path / "turning.py").write_text(f"open({str(tmp_path / 'made')!r}, 'w')\n{RIGHT}")
    assert mindc("check", tmp_path / "calling.mind").code == 0
    assert not (tmp_path / "made").exists()


def test_a_missing_file_is_a_mistake(mindc: Call, tmp_path: Path) -> None:
    (tmp_path / "calling.mind").write_text(CALLING)
    assert "cannot read" in mindc("check", tmp_path / "calling.mind").err


def test_a_text_of_deep_sums_ends_in_a_sentence() -> None:
    with pytest.raises(ProcedureError):
        fit("m.f", "def f(a):\n    return a" + " + a" * 5000, 1, 1)
