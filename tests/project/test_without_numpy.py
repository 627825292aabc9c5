"""What reads text needs none of what computes: it says the same in a Python in which importing numpy fails."""

import ast
import json
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.project.sources import ROOT, RUNTIME, modules, tree

PROGRAM = """
import sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {names}:
            raise ImportError(f"there is no {{name}} here")

sys.meta_path.insert(0, Refuse())
{then}
"""
COMPUTING = {"numpy", "numba", "llvmlite", "pymunk", "cv2", "PIL", "matplotlib", "websockets"}
COMMAND = "from mindlang.cli import main; main()"
SESSION = """
import contextlib, io, json
from pathlib import Path
from mindlang.cli import main

def said(words):
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        sys.argv[1:] = words
        try:
            main()
        except SystemExit as end:
            return end.code, out.getvalue(), err.getvalue()
    return 0, out.getvalue(), err.getvalue()

def told(path):
    from mindlang.server.server import EditorSession

    session = EditorSession()
    session.set(path.as_uri(), 1, path.read_text().replace("reads proximity", "reads proximty"))
    return [(news.uri, [(each.code, each.message, each.range) for each in news.diagnostics]) for news in session.news()]

mind, has_editor, *commands = json.loads(sys.argv[1])
print(json.dumps([*map(said, commands), *([told(Path(mind).resolve())] if has_editor else [])], default=str))
"""
COLLECT = "examples/collect/collect.mind"
MAX_CHECK_MODULES = 115


def run(program: str, words: Sequence[str], refused: set[str]) -> tuple[int, str, str]:
    """How a program ends in a Python without these packages, and what it prints."""
    text = PROGRAM.format(names=refused or {""}, then=program)
    done = subprocess.run([sys.executable, "-c", text, *words], capture_output=True, text=True, cwd=ROOT)
    return done.returncode, done.stdout, done.stderr


def test_commands_and_an_editor_say_the_same(tmp_path: Path) -> None:
    constant = tmp_path / "constant.mind"
    text = (ROOT / "examples/braitenberg.mind").read_text()
    constant.write_text(f"{text}\nsensor always is computed at greatest of 0.1 (1 / 0)\n")
    commands = (
        ("check", COLLECT),
        ("check", "examples/lander/lander.mind", "examples/collect/collect.break"),
        ("lint", COLLECT, "examples/collect/monolith.mind"),
        ("lint", str(constant)),
        ("fmt", "--diff", "examples/maze/maze.mind"),
        ("explain",),
        ("explain", "unread-sensor"),
        ("explain", "ultrasonic"),
        ("check", "tests/language/wrong/influence-cycle.mind"),
        ("show", "examples/braitenberg.mind"),
        ("show", COLLECT, "--dot"),
        ("schema",),
    )
    asked = json.dumps([COLLECT, find_spec("pygls") is not None, *commands])
    without, whole = (json.loads(run(SESSION, [asked], refused)[1]) for refused in (COMPUTING, set()))
    for words, found, expected in zip(commands, without, whole, strict=False):
        assert found == expected, words
        assert "there is no" not in found[2]
        assert found[1] or found[2], words
    for news in without[len(commands) :]:
        assert "unknown-sensor" in str(news)
    assert without == whole


def test_check_imports_what_it_uses() -> None:
    """Of the 770 modules of ours; each costs some 0.5 ms, a frozen dataclass in it as much again."""
    counted = "import atexit; atexit.register(lambda: print(sum(each.startswith('mind') for each in sys.modules)))\n"
    assert int(run(counted + COMMAND, ["check", COLLECT], set())[1]) <= MAX_CHECK_MODULES


@pytest.mark.parametrize(
    "path", modules(RUNTIME / "kinds" / "sensors", RUNTIME / "kinds" / "functions"), ids=lambda path: path.stem
)
def test_the_methods_of_a_kind_import_what_they_use(path: Path) -> None:
    """What a file imports for checkers of types is there in a lane alone, which is given it when it is compiled."""
    guarded = {name for node in tree(path).body if isinstance(node, ast.If) for name in bound(node)}
    methods = (each for kind in tree(path).body if isinstance(kind, ast.ClassDef) for each in kind.body)
    named = [each for each in methods if isinstance(each, ast.FunctionDef) and each.name != "lane"]
    assert {each.name: lacks for each in named if (lacks := (used(each) & guarded) - bound(each))} == {}


def bound(within: ast.AST) -> set[str]:
    """The names that are imported in it."""
    imports = (node for node in ast.walk(within) if isinstance(node, ast.Import | ast.ImportFrom))
    return {alias.asname or alias.name for node in imports for alias in node.names}


def used(function: ast.FunctionDef) -> set[str]:
    """The names in its statements, without those of annotations."""
    noted = [getattr(node, field, None) for node in ast.walk(function) for field in ("annotation", "returns")]
    left_out = {id(node) for each in noted if isinstance(each, ast.AST) for node in ast.walk(each)}
    return {node.id for node in ast.walk(function) if isinstance(node, ast.Name) and id(node) not in left_out}
