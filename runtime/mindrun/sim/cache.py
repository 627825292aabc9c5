"""Machine code kept between starts: made for this very processor in the user's cache, and for its kind in the wheel.

A file is named by all that it depends on (the sources, the versions of Python, numba and llvmlite, the processor, the
types), so one that stands there fits, and begins with a hash, so one that is damaged is made anew.
"""

import atexit
import fcntl
import os
import shutil
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import IO

from llvmlite.binding import get_host_cpu_features

from mindrun.files.user_cache import user_cache
from mindrun.sim.dependencies import HASH_DIGITS, called, fingerprint, functions
from mindrun.sim.machine_code import load, target
from mindrun.sim.units import Unit

SIM_FOLDER = Path(__file__).parent
SHIPPED = SIM_FOLDER / "compiled"  # in the wheel
# The kinds of processors for which wheels have machine code, and what one must have to run it, as LLVM writes it.
PROCESSORS = {"x86-64-v3": "+avx,+avx2,+bmi,+bmi2,+f16c,+fma,+lzcnt,+movbe,+popcnt,+sse4.2", "generic": "+neon"}
HASH_BYTES = 32
FOLDER = "compiled"  # in the user's cache
# Of several processes that lack the same code one compiles it, and the others wait so long. Then each compiles for
# itself: the other may be stopped, or its machine be gone while a shared disk keeps its lock.
WAIT_SECONDS = 600.0
ASK_AGAIN_SECONDS = 0.05


@cache
def folder() -> Path:
    """The folder of machine code: in the user's cache; where that cannot be written, one of this process alone.

    It is not there where nothing can be written at all.
    """
    with suppress(OSError, RuntimeError):  # RuntimeError: there is no home
        found = user_cache() / FOLDER
        found.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=found):
            return found
    with suppress(OSError):
        own = Path(tempfile.mkdtemp(prefix="mind-"))  # never a known name: whoever can write it can run code here
        atexit.register(shutil.rmtree, own, ignore_errors=True)
        found = own / FOLDER
        found.mkdir()
        return found
    return Path(os.devnull) / FOLDER


def lasts() -> bool:
    """True where what is kept is there at the next start."""
    with suppress(RuntimeError):
        return folder().parent == user_cache()
    return False


def address_of(unit: Unit) -> int:
    """The address of a unit's machine code, loaded now; it is made, and kept, where there is none."""
    if (code := find(unit)) is None:
        with exclusive(_kept(unit).with_suffix(".lock"), WAIT_SECONDS):
            code = find(unit) or _make(unit)
    return load(code, unit.name, {each.slot_name: each.place for each in called(unit)})


Unit.address_of = address_of


def make_missing(units: Iterable[Unit]) -> None:
    """Compile those of some units of which there is no machine code, the largest first.

    Beside other processes that do the same: nobody compiles what another one is at, and all end when all is there.
    """
    waiting = missing(units)
    waiting.sort(key=lambda unit: sum(len(each.__code__.co_code) for each in functions(unit.function)), reverse=True)
    for patience in (0.0, WAIT_SECONDS):
        for unit in [*waiting]:
            with exclusive(_kept(unit).with_suffix(".lock"), patience) as is_alone:
                if is_alone:
                    if find(unit) is None:
                        _make(unit)
                    waiting.remove(unit)


def missing(units: Iterable[Unit]) -> list[Unit]:
    """Those of some units of which there is no machine code."""
    return [each for each in units if find(each) is None]


def find(unit: Unit) -> bytes | None:
    """The machine code of a unit, kept or shipped; None where there is none."""
    paths = [_kept(unit), *(SHIPPED / _file(unit, kind, PROCESSORS[kind]) for kind in fitting())]
    return next((code for path in paths if (code := _read(path)) is not None), None)


def is_native(unit: Unit) -> bool:
    """True if it is kept, made for this very processor."""
    return _read(_kept(unit)) is not None


def _kept(unit: Unit) -> Path:
    return folder() / _file(unit, target().processor, target().features)


def _file(unit: Unit, processor: str, features: str) -> str:
    """The name of a unit's file for a kind of processors."""
    digest = sha256(f"{fingerprint(unit)} {target().triple} {features}".encode()).hexdigest()[:HASH_DIGITS]
    return f"{unit.name.removeprefix('mindrun.')}-{processor}-{digest}.code"


def _make(unit: Unit) -> bytes:
    """Compile a unit and keep it; where that fails, it is compiled again another time."""
    from mindrun.sim.compiling import compile_unit

    code = compile_unit(unit)
    with suppress(OSError):
        _write(_kept(unit), code)
    return code


def fitting() -> list[str]:
    """The kinds of PROCESSORS whose code this one can run; none where a user wants another's code."""
    if os.environ.get("NUMBA_CPU_NAME") or os.environ.get("NUMBA_CPU_FEATURES"):
        return []
    has = {f"+{name}" for name, is_there in get_host_cpu_features().items() if is_there}
    return [kind for kind, needs in PROCESSORS.items() if {*needs.split(",")} <= has]


def _read(path: Path) -> bytes | None:
    """The data that `_write` put into a file; None where it is missing or damaged."""
    with suppress(OSError):
        data = path.read_bytes()
        if sha256(data[HASH_BYTES:]).digest() == data[:HASH_BYTES]:
            return data[HASH_BYTES:]
    return None


def _write(path: Path, data: bytes) -> None:
    """Write a file beside, then rename it: another process may be reading."""
    with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
        beside = Path(file.name)
        try:
            file.write(sha256(data).digest() + data)
            file.flush()
            beside.replace(path)
        finally:
            beside.unlink(missing_ok=True)


@contextmanager
def exclusive(path: Path, patience: float) -> Iterator[bool]:
    """A context that one process at a time is in for a `path`: True; False where others are in it for so many seconds.

    Where it cannot be locked, or after WAIT_SECONDS, any number are: True. A POSIX lock: it ends with its process, and
    processes forked meanwhile do not have it. Of threads it knows nothing.
    """
    with ExitStack() as held:
        is_alone = True
        with suppress(OSError):
            is_alone = _lock(held.enter_context(path.open("ab")), patience)
        yield is_alone or patience == WAIT_SECONDS


def _lock(file: IO[bytes], seconds: float) -> bool:
    """Wait for the lock of a file for so many seconds; True when this process has it."""
    until = time.monotonic() + seconds
    while True:
        try:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except (BlockingIOError, PermissionError):  # both mean that another process has it
            if time.monotonic() >= until:
                return False
        time.sleep(ASK_AGAIN_SECONDS)
