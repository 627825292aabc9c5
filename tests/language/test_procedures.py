"""What is said of procedures from their text: by every door alike, before anything runs."""

import json
from contextlib import nullcontext
from pathlib import Path

import pytest
from mindrun.errors import ProcedureError
from mindrun.kinds.procedure_text import fit

import mindlang
from mindlang.lock.training_world import LessonKey
from mindlang.lock.world_changes import changes
from mindlang.lock.world_facts import Worlds
from mindlang.server.workspace import view
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
    "import importlib\nx = importlib.import_module('rules')\ndef turn(a, b, c): return 1, 2": "imports rules, a file",
    "x = open('none')\ndef turn(a, b, c): return 1, 2": "looks for a file with open, and no bundle holds one",
    "def turn(a, b, c):\n  with open(mode='r+', file=a): return 1, 2": "looks for a file with open",
    "import numpy as n\nW = n.load('w.npy')\ndef turn(a, b, c): return 1, 2": "looks for a file with numpy.load",
    "from torch.jit import load as l\nW = l('w')\ndef turn(a, b, c): return 1, 2": "a file with torch.jit.load",
    "from pathlib import Path\nW = Path('w').read_text()\ndef turn(a, b, c): return 1, 2": "a file with read_text",
    "import pathlib\ndef turn(a, b, c):\n  with a.open(): return 1, 2": "looks for a file with open",
    "HERE = __file__\ndef turn(a, b, c): return 1, 2": "looks for a file with __file__",
    "import cv2\nN = cv2.dnn.Net(model='policy.onnx')\ndef turn(a, b, c): return 1, 2": "names policy.onnx, a file",
    "def turn(a, b, c): return len(open('w').read()), 2\ndef other(open): return open(1)": "a file with open",
    "from pathlib import Path as P\ndef turn(a, b, c):\n  with P('w').open(): return 1, 2": "a file with open",
    "import pathlib as p\nW = p.Path.read_text(p.Path('w'))\ndef turn(a, b, c): return 1, 2": "pathlib.Path.read_text",
    "import io as i\nf = g = i.open\ndef turn(a, b, c): return len(g('x').read()), 2": "a file with io.open",
    "def turn(a, b, c, get=open): return len(get('x').read()), 2": "looks for a file with open",
    "class A:\n  def open(s): return open('x')\ndef turn(a, b, c): return 1, 2": "looks for a file with open",
    "import os\nW = os.open('w', os.O_RDONLY)\ndef turn(a, b, c): return 1, 2": "a file with os.open",
    "import sqlite3 as s\ndef turn(a, b, c): return s.connect('a.db').total_changes, 2": "a file with sqlite3.connect",
    "import shelve\ndef turn(a, b, c): return shelve.open('a')['x'], 2": "looks for a file with shelve.open",
    "from importlib import resources\nR = resources.files('x')\ndef turn(a, b, c): return 1, 2": "resources.files",
    "from numpy import *\nW = loadtxt('w.txt')\ndef turn(a, b, c): return 1, 2": "a file with numpy.loadtxt",
    "import parts.claw\ndef turn(a, b, c): return 1, 2": "imports parts.claw, a folder that no bundle holds",
    "from parts import claw\ndef turn(a, b, c): return 1, 2": "imports parts, a folder that no bundle holds",
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
    "'policy.onnx'\ndef turn(a, b, c):\n    'policy.onnx'\n    return len('policy.mind'), 2",
    "def open(a): return a\ndef turn(a, b, c): return open(a), 2",
    "import json, io, numpy\nW = numpy.load(io.BytesIO(b''))\nX = json.loads('1')\ndef turn(a, b, c): return 1, 2",
    "def turn(a, b, c):\n    with open('policy.onnx', 'w') as log: log.write('a')\n    return 1, 2",
    "try:\n    import cv2_of_the_robot\nexcept ImportError:\n    cv2 = None\ndef turn(a, b, c): return 1, 2",
    "def turn(a, b, c):\n    open = max\n    return open(a, b), 2",
    "def turn(a, b, c):\n    def inner(open): return open(1)\n    return inner(abs), [open(1) for open in [abs]][0]",
    "from json import *\ndef turn(a, b, c): return len(dumps(a)), 2\ndef other(handle): return load(handle)",
    "import random\ndef turn(random, b, c): return random.real, 2",
    "import os\ndef turn(a, b, c): return os.open('log', os.O_WRONLY | os.O_CREAT), 2",
    "f = g\ng = f\ndef turn(a, b, c): return f(1), 2",
    "def turn(a, b, c):\n    def inner(): return 1, 2, 3\n    return inner()[:2]",
)


@pytest.fixture
def calling(tmp_path: Path) -> Path:
    (tmp_path / "calling.mind").write_text(CALLING)
    (tmp_path / "rules.py").touch()
    (tmp_path / "policy.onnx").touch()
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "claws.py").touch()
    return tmp_path / "calling.mind"


@pytest.mark.parametrize("source", WRONG)
def test_every_door_says_what_is_wrong(mindc: Call, calling: Path, source: str) -> None:
    (calling.parent / "turning.py").write_text(source)
    bundle = calling.parent / "x.bundle"
    for words in (["check"], ["lint"], ["build", "-o", bundle, "--master", "Turn"]):
        done = mindc(words[0], calling, *words[1:])
        assert done.code == 1
        assert "[faulty-procedure]" in done.out + done.err
        assert WRONG[source] in done.out + done.err
    assert not bundle.exists()
    mind = mindlang.load(calling)
    assert not mind.is_valid
    for found in (mind.diagnostics, view(calling, {}).findings):
        [fault] = [each for each in found if each.code == "faulty-procedure"]
        assert fault.severity == "error"
        assert WRONG[source] in fault.message
    ran = mindc("run", calling, "--task", "Roam", "--master", "Turn")
    assert ran.code == 2
    assert WRONG[source] in ran.err
    with pytest.raises(ProcedureError):
        mind.engine("Turn")


def test_every_door_says_which_file_is_missing(mindc: Call, calling: Path) -> None:
    calling.write_text(CALLING.replace("turning.turn\n", 'turning.turn\n  uses "policy.onnx"\n'))
    (calling.parent / "turning.py").write_text(f"FILE = open(__file__), 'policy.onnx'\n{RIGHT}")
    bundle = calling.parent / "x.bundle"
    assert (mindc("check", calling).code, mindlang.load(calling).is_valid) == (0, True)
    assert mindc("build", calling, "-o", bundle, "--master", "Turn").code == 0
    (calling.parent / "turning.py").write_text(f"FILE = 'policy.onnx'\n{RIGHT}")
    assert "never says __file__" in mindc("check", calling).err
    (calling.parent / "turning.py").write_text(f"FILE = open(__file__), 'policy.onnx'\n{RIGHT}")
    (calling.parent / "policy.onnx").unlink()
    mind = mindlang.load(calling)
    said = [mindc(*words).err + mindc(*words).out for words in (("check", calling), ("lint", calling))]
    found = *mind.diagnostics, *view(calling, {}).findings
    said += [each.message for each in found if each.code == "faulty-procedure"]
    assert ["policy.onnx (No such file or directory)" in each for each in said] == [True] * 4
    assert mindc("build", calling, "-o", bundle, "--master", "Turn").code == 1


def test_a_changed_file_is_another_world(calling: Path) -> None:
    calling.write_text(CALLING.replace("turning.turn\n", 'turning.turn\n  uses "policy.onnx"\n'))
    (calling.parent / "turning.py").write_text(RIGHT)
    (calling.parent / "policy.onnx").write_bytes(b"1")
    graph, lesson = mindlang.load(calling).graph, LessonKey("Roam", "Turn", False)
    how = {
        "from_scratch": True,
        "task": "Roam",
        "master": "Turn",
        "with_subskills": False,
        "learner": {"is": "genetic"},
    }
    before = Worlds(graph, calling.parent).of_gone(lesson, how)
    (calling.parent / "policy.onnx").write_bytes(b"2")
    after = Worlds(graph, calling.parent).of_gone(lesson, how)
    assert changes(before, after) == ["policy.onnx, which Turn uses, has changed"]


def test_what_another_skill_calls_is_in_nobodys_way(mindc: Call, calling: Path) -> None:
    """A hierarchy can be shown and edited before its module is written, and others of its skills built: it is said."""
    assert mindc("show", calling).code == 0
    assert mindc("edit", "rename", calling, "Turn", "Swing", "--noun", "skill").code == 0
    built = mindc("build", calling, "-o", calling.parent / "x.bundle", "--master", "Chase")
    assert built.code == 0
    assert "warning: Procedure from turning.turn: cannot read" in built.err
    mind = mindlang.load(calling)
    assert mind.edit("rename", old="Turn", new="Swing", noun="skill").diff
    assert mind.bench("Chase", runs=2, master="Chase")["runs"] == 2


def test_no_edit_breaks_a_procedure(mindc: Call, calling: Path) -> None:
    """One more sensor is one more number, which the function does not take."""
    (calling.parent / "turning.py").write_text(RIGHT, encoding="utf-8")
    said = mindc("edit", "connect", calling, "Turn", "ball_bearing", "--write")
    assert said.code != 0
    assert "After this edit the mind would not compile" in said.err
    assert mindc("check", calling).code == 0


def test_what_the_robot_needs_is_said(mindc: Call, calling: Path) -> None:
    """Of modules that are not here it is said everywhere, and nothing is refused: they may be on the robot."""
    text = "import {}\nimport numpy, json\n" + RIGHT
    bundle = calling.parent / "x.bundle"
    build = "build", calling, "-o", bundle, "--master", "Turn"
    (calling.parent / "turning.py").write_text(text.format("hypothesis.strategies as st"))
    assert mindc("check", calling).code == 0
    note = "the robot needs {} (turning.py, line 1), which no bundle holds"
    assert note.format("hypothesis") in mindc(*build).err
    (calling.parent / "turning.py").write_text(text.format("eyes_of_the_robot"))
    missing = "imports eyes_of_the_robot, which is not installed here (turning.py, line 1)"
    assert missing in mindc("check", calling).err
    assert missing in mindc("lint", calling).out
    assert [each.severity for each in mindlang.load(calling).diagnostics] == ["warning"]
    assert mindlang.load(calling).is_valid
    built = mindc(*build, "--json")
    assert built.code == 0
    assert missing in built.err
    assert json.loads(built.out)["notes"] == [note.format("eyes_of_the_robot")]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("import numpy.nosuch", "imports numpy.nosuch, which numpy does not have here (turning.py, line 1)"),
        ("from numpy import nosuch", "imports numpy.nosuch, which numpy does not have here"),
        ("from numpy.nosuch import a", "imports numpy.nosuch, which numpy does not have here"),
        ("from os import path, nosuch", "imports os.nosuch, which os does not have here"),
        ("import os.nosuch", "imports os.nosuch, which os does not have here"),
        ("from numpy import linalg, sin", ""),
        ("import numpy.linalg, xml.dom", ""),
        ("from xml import dom", ""),
        ("try:\n    from numpy import nosuch\nexcept ImportError:\n    nosuch = None", ""),
    ],
)
def test_what_python_and_numpy_have_is_asked(mindc: Call, calling: Path, line: str, said: str) -> None:
    """It is a warning, as of modules that are not installed, and no module of others is run for it."""
    (calling.parent / "turning.py").write_text(f"{line}\n{RIGHT}")
    checked = mindc("check", calling)
    built = mindc("build", calling, "-o", calling.parent / "x.bundle", "--master", "Turn")
    assert (checked.code, built.code) == (1 if said else 0, 0)
    assert ("warning" in checked.err) == bool(said)
    assert said in checked.err
    assert said in built.err


@pytest.mark.parametrize("source", FINE)
def test_nothing_is_said_of_what_may_be_right(mindc: Call, calling: Path, source: str) -> None:
    (calling.parent / "turning.py").write_text(source, encoding="utf-8")
    assert mindc("check", calling).code == 0


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


@pytest.mark.parametrize("read", ["", "v0 = open\n"])
def test_names_that_are_given_to_one_another_have_an_end(read: str) -> None:
    """Each of twenty stands for what all others do, and for attributes of it."""
    given = (f"v{i} = v{j} if v{i} else v{j}.next\n" for i in range(20) for j in range(20))
    text = f"{read}{''.join(given)}def turn(a, b, c): return v7('w'), 1"
    with pytest.raises(ProcedureError, match="a file with open") if read else nullcontext():
        fit("calls.turn", text, 3, 2)
