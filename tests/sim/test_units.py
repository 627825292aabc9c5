"""Units: compiled at the latest by their first call, handed no more than they take, and never gone on with in error."""

import copy
import ctypes
import gc
import os
import struct
import subprocess
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.sim import cache
from mindrun.sim.numba_internals import COLLECTION_OBJECTS, rare_collections
from mindrun.sim.units import FAILED_CODE
from mindrun.sim.warmup import every_unit

from tests.calling import Call
from tests.language.examples import COLLECT, ROOT
from tests.sim.conftest import NEEDED, Write

NESTED = """
@unit
def inner(x: int) -> int:
    return x + 1

@unit
def outer(x: int) -> int:
    return 2 * inner(x)
"""
PARTS = """
def room(dtype, dimensions):
    return array(dtype, dimensions, lambda counts, lanes: (lanes,) * dimensions)

@dataclass(frozen=True)
class Inside(Block):
    numbers: Any = room(np.float64, 1)

@dataclass(frozen=True)
class Part(Block):
    table: Any = room(np.int64, 2)
    inside: Inside

@unit
def total(part: Part, row: int, share: float) -> float:
    return (part.table[row, 0] + part.table[row, 1]) * share + part.inside.numbers[-1]
"""
MOST_CODE_BYTES = 60_000  # of one unit: LLVM takes longer than in proportion
EXACT = {
    "floor",
    "memcpy",
    "memmove",
    "memset",
    "rint",
    "sqrt",
}  # no other function of C gives the same bits everywhere
SYMBOLS = 2  # the type of the section of an object file


def test_a_unit_is_compiled_by_its_first_call_from_compiled_code(place: Path, write: Write, made: list[str]) -> None:
    """In any thread; what is called later goes straight there."""
    lanes = write(NESTED)
    found: list[int] = []
    thread = threading.Thread(target=lambda: found.append(lanes.outer(20)))
    thread.start()
    thread.join()
    assert found == [42]
    assert made == ["written.outer", "written.inner"]
    slot = ctypes.c_uint64.from_address(lanes.inner.place).value
    assert slot == ctypes.cast(lanes.inner.load(), ctypes.c_void_p).value
    assert lanes.outer(1) == 4


def test_of_many_threads_one_compiles(place: Path, write: Write, made: list[str]) -> None:
    lanes, threads = write(NESTED), 4
    together = threading.Barrier(threads)

    def call(number: int) -> int:
        together.wait()
        return int((lanes.outer if number % 2 else lanes.inner)(number))

    with ThreadPoolExecutor(threads) as pool:
        assert [*pool.map(call, range(threads))] == [1, 4, 3, 8]
    assert sorted(made) == ["written.inner", "written.outer"]


def run(program: str, folder: Path) -> "subprocess.CompletedProcess[str]":
    """A program with units of its own, which must not come to its last line."""
    words = [sys.executable, "-c", f"import sys\n{NEEDED}from mindrun.sim import cache\n{program}\nprint('goes on')"]
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder)}
    return subprocess.run(words, capture_output=True, text=True, cwd=ROOT, env=environment, check=False)


@pytest.mark.parametrize("before", ["", "sys.stderr.close()"])
def test_what_cannot_be_compiled_ends_the_process(tmp_path: Path, before: str) -> None:
    """Said in Python it would be an exception: but C goes on."""
    broken = NESTED.replace("x + 1", "x.nothing")
    done = run(f"{broken}\nouter.load()\n{before}\nouter(1)", tmp_path)
    assert (done.returncode, done.stdout) == (FAILED_CODE, "")
    assert done.stderr.startswith("" if before else "__main__.inner cannot be compiled: ")
    assert bool(done.stderr) == (not before)


def test_a_unit_that_raises_ends_the_process(tmp_path: Path) -> None:
    raising = NESTED.replace("    return x + 1", "    if x > 3:\n        raise ValueError('large')\n    return x")
    done = run(f"{raising}\nprint(outer(3), flush=True)\nouter(4)", tmp_path)
    assert done.stdout == "6\n"
    assert done.returncode < 0


def test_arguments_that_c_would_cut_off_are_refused(place: Path, write: Write) -> None:
    lanes = write(PARTS)
    inside = lanes.Inside(np.array([5.0]))
    part = lanes.Part(np.array([[1, 2], [3, 4]]), inside)
    assert lanes.total(part, 1, 0.5) == 8.5
    assert lanes.total(part, np.bool_(True), np.float32(2)) == 19
    for row in (0.5, 2**63, -(2**64)):
        with pytest.raises(TypeError, match="is no whole number of 64 bits"):
            lanes.total(part, row, 0.5)
    for other in (inside, part.address, None):
        with pytest.raises(TypeError, match="where Part is declared"):
            lanes.total(other, 1, 0.5)
    for given in ((part, 1), (part, 1, 0.5, 0)):
        with pytest.raises(ValueError, match="zip"):
            lanes.total(*given)


@pytest.mark.parametrize(
    "table",
    [
        np.zeros((2, 2), np.int32),
        np.zeros((2, 2), ">i8"),
        np.zeros(4, np.int64),
        np.zeros((2, 2), np.int64, order="F"),
        np.zeros((2, 4), np.int64)[:, ::2],
        [[0, 0], [0, 0]],
    ],
)
def test_a_block_of_other_arrays_has_no_address(write: Write, table: Any) -> None:
    lanes = write(PARTS)
    with pytest.raises(TypeError, match=r"Part\.table is not int64 in 2 dimensions"):
        print(lanes.Part(table, lanes.Inside(np.zeros(1))).address)
    with pytest.raises(TypeError, match=r"Part\.inside is not Inside"):
        print(lanes.Part(np.zeros((1, 1), np.int64), np.zeros(1)).address)


def test_a_copy_of_a_block_has_words_of_its_own(place: Path, write: Write) -> None:
    lanes = write(PARTS)
    part = lanes.Part(np.array([[1, 2]]), lanes.Inside(np.array([0.0])))
    assert lanes.total(part, 0, 1.0) == 3
    other = copy.deepcopy(part)
    other.table[0] = 20
    assert (lanes.total(part, 0, 1.0), lanes.total(other, 0, 1.0)) == (3, 40)


def test_of_several_threads_all_hand_over_the_same_words(write: Write) -> None:
    """Those of one that came too late would be gone while compiled code reads them."""
    lanes, found = write(PARTS), list[int]()

    class Part(lanes.Part):  # type: ignore[name-defined,misc]
        def _words(self) -> Iterator[int]:
            if not found:
                found.append(0)
                found[0] = self.address  # as another thread asks in the meantime
            yield from super()._words()

    part = Part(np.zeros((1, 1), np.int64), lanes.Inside(np.zeros(1)))
    assert part.address == part.address == found[0]


def test_kinds_of_blocks_may_have_one_name(place: Path, write: Write) -> None:
    for fields in ("table", "first", "last"):
        more = f"    {fields}: Any = room(bool, 1)\n    inside: Inside\n"
        lanes = write(PARTS.replace("    inside: Inside\n", "    inside: Inside\n" if fields == "table" else more))
        extra = {} if fields == "table" else {fields: np.zeros(1, bool)}
        part = lanes.Part(table=np.array([[1, 2]]), inside=lanes.Inside(np.array([4.0])), **extra)
        assert lanes.total(part, 0, 1.0) == 7


def undefined(code: bytes) -> Iterator[str]:
    """The names that an object file of ELF takes from elsewhere."""
    (sections,), (count,) = struct.unpack_from("<Q", code, 40), struct.unpack_from("<H", code, 60)
    headers = [struct.unpack_from("<IIQQQQIIQQ", code, sections + 64 * number) for number in range(count)]
    for _, kind, _, _, start, size, strings, _, _, step in headers:
        for symbol in range(start + step, start + size, step) if kind == SYMBOLS else ():
            name, _, _, section = struct.unpack_from("<IBBH", code, symbol)
            if section == 0:
                yield code[headers[strings][4] + name :].partition(b"\0")[0].decode()


def test_machine_code_calls_nothing_but_units_and_what_is_exact(mindc: Call) -> None:
    """Nothing of numba's, which is not there when it is loaded: it would count references for half of the time."""
    mindc("warmup")
    for unit in every_unit():
        code = cache.find(unit)
        assert code is not None
        assert len(code) < MOST_CODE_BYTES, unit.name
        if code.startswith(b"\x7fELF\x02\x01"):
            assert {name for name in undefined(code) if not name.startswith("slot of ")} <= EXACT, unit.name


WARM = f"""
import sys
import numpy as np
from mindlang.compiler.compile import load
from mindlang.lock.status import make_ready
from mindrun.sim.rollout import Rollout
from mindrun.sim.warmup import every_unit
found = load({str(COLLECT)!r})
rollout = Rollout(make_ready(found.graph, found.sources).policy, "Collect", "Collect")
rollout.compile()
print(rollout.score(np.zeros((1, 0), np.float32), [1]).ticks)
for unit in every_unit():
    unit.load()
print("numba" in sys.modules)
"""


def test_a_warm_start_imports_no_numba(mindc: Call) -> None:
    mindc("warmup")
    done = subprocess.run([sys.executable, "-c", WARM], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stdout.splitlines()[1] == "False", done.stdout


def test_garbage_is_looked_for_as_before_once_it_is_compiled() -> None:
    before, inside = gc.get_threshold(), []

    @rare_collections()
    def compiling() -> None:
        inside.append(gc.get_threshold())
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        compiling()
    assert inside == [(COLLECTION_OBJECTS, *before[1:])]
    assert gc.get_threshold() == before
