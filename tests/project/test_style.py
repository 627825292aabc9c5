"""Ruff and mypy are content; files, functions and names are as CONTRIBUTING asks. Each exception has its reason."""

import ast
import fcntl
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from mindrun.files.user_cache import user_cache

from tests.project.sources import COMPILER, ROOT, RUNTIME, modules, nodes, tree

BENCHMARKS, EXAMPLES = ROOT / "benchmarks", ROOT / "examples"
FILE_LINES, FUNCTION_LINES, TEST_FILE_LINES = 400, 40, 450
LONG_FILES = {
    "mindlang/compiler/syntax.py": "one dataclass for each thing that a line can say",
    "tests/sim/plain_world.py": "a whole world the obvious way, to be read at one go",
    "tests/lock/test_worlds.py": "one mind with every kind, and what is noticed of each",
}
LONG_FUNCTIONS = {
    "mindlang/compiler/resolve/__init__.py: resolve_mind": "a line for each stage, in their order",
}
SHORT_CONSTANTS = {  # that are numbers of one word
    "mindlang/cli/_terminal.py": "exit codes, as they are called",
    "runtime/mindrun/__main__.py": "exit codes, as they are called",
    "runtime/mindrun/robot/guardian/__main__.py": "exit codes, as in sysexits.h",
    "runtime/mindrun/robot/processes.py": "an exit code",
    "runtime/mindrun/robot/drivers/ads1115.py": "registers and bits, as the data sheet calls them",
    "runtime/mindrun/robot/drivers/grove_motor.py": "commands, as the data sheet calls them",
    "runtime/mindrun/robot/drivers/mpu6050.py": "registers and bits, as the data sheet calls them",
    "runtime/mindrun/robot/drivers/pca9685.py": "registers and bits, as the data sheet calls them",
    "runtime/mindrun/robot/drivers/vl53l0x.py": "registers and bits, as the data sheet calls them",
    "runtime/mindrun/numbers/trigonometry.py": "the coefficients of Cody and Waite, in their order",
    "runtime/mindrun/numbers/arithmetic.py": "rows of a thing and lanes of a vector, which kinds name in every loop",
    "runtime/mindrun/sim/codes.py": "the codes of the tables, in the words of the language",
}


def test_mypy_is_content() -> None:
    """With what it found in any clone, half a minute is a second; two at once would find its database locked."""
    folder = user_cache() / "mypy"
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        is_content("mypy", "--cache-dir", str(folder))


@pytest.mark.parametrize("command", ["check", "format --check"])
def test_ruff_is_content(command: str) -> None:
    is_content("ruff", *command.split(), ".")


def is_content(*command: str) -> None:
    """Fail with what a checker says of the project."""
    done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_file_is_long() -> None:
    code = dict.fromkeys(modules(COMPILER, RUNTIME, BENCHMARKS, EXAMPLES), FILE_LINES)
    tests = dict.fromkeys(modules(ROOT / "tests"), TEST_FILE_LINES)
    assert {name(path) for path, limit in (code | tests).items() if lines(path) > limit} == set(LONG_FILES)


def test_no_function_is_long() -> None:
    assert {
        f"{name(path)}: {node.name}"
        for path in modules(COMPILER, RUNTIME, BENCHMARKS, EXAMPLES)
        for node in definitions(path)
        if not isinstance(node, ast.ClassDef) and (node.end_lineno or 0) - node.lineno >= FUNCTION_LINES
    } == set(LONG_FUNCTIONS)


def test_constants_say_what_they_count() -> None:
    """A number of a module has a noun and a unit."""
    assert {
        name(path)
        for path in modules(COMPILER, RUNTIME, BENCHMARKS, EXAMPLES)
        for constant, value in constants(path)
        if "_" not in constant.strip("_") and is_number(value)
    } == set(SHORT_CONSTANTS)


def test_asserts_only_narrow_types() -> None:
    """`python -O` removes them: what has to be checked raises an error of its own."""
    assert [
        f"{name(path)}:{node.lineno} {ast.unparse(node.test)}"
        for path in modules(COMPILER, RUNTIME)
        for node in nodes(path)
        if isinstance(node, ast.Assert) and not narrows(node.test)
    ] == []


@pytest.mark.parametrize("package", [COMPILER, RUNTIME])
def test_the_annotations_are_there_for_others(package: Path) -> None:
    assert (package / "py.typed").is_file()


def name(path: Path) -> str:
    """A file as seen from the project."""
    return path.relative_to(ROOT).as_posix()


def lines(path: Path) -> int:
    """How many lines a file has."""
    return len(path.read_text(encoding="utf-8").splitlines())


def definitions(path: Path) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef]:
    """Every function and class of a file, wherever it stands."""
    for node in nodes(path):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node


def constants(path: Path) -> Iterator[tuple[str, ast.expr]]:
    """The names in capitals that a module gives to values, and the values."""
    for node in tree(path).body:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
            several = isinstance(target, ast.Tuple)
            names = target.elts if several else [target]
            paired = isinstance(node.value, ast.Tuple) and several
            values = node.value.elts if paired else [node.value] * len(names)
            yield from ((each.id, value) for each, value in zip(names, values, strict=True) if is_constant(each))


def is_constant(node: ast.expr) -> bool:
    """Whether a name is in capitals and of more than one letter: F and T are types."""
    return isinstance(node, ast.Name) and node.id.isupper() and len(node.id) > 1


def is_number(value: ast.expr) -> bool:
    """Whether an expression is a number, or a tuple of numbers."""
    match value:
        case ast.Constant(value=number):
            return isinstance(number, int | float) and not isinstance(number, bool)
        case ast.UnaryOp(operand=operand):
            return is_number(operand)
        case ast.BinOp(left=left, right=right):
            return is_number(left) and is_number(right)
        case ast.Tuple(elts=[_, *_] as values):
            return all(map(is_number, values))
    return False


def narrows(test: ast.expr) -> bool:
    """Whether a test says no more than of which type a value is: `x`, `x is not None`, `isinstance(x, T)`."""
    match test:
        case ast.Name() | ast.Attribute():
            return True
        case ast.Compare(ops=[ast.IsNot()], comparators=[ast.Constant(value=None)]):
            return True
        case ast.Call(func=ast.Name(id="isinstance")):
            return True
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return narrows(operand)
    return False
