"""Machine code kept between starts: made for this very processor in the user's cache, and for its kind in the wheel.

A file is named by all that it depends on (the sources, the versions of Python, numba and llvmlite, the processor, the
types), so one that stands there fits, and begins with a hash, so one that is damaged is made anew.
"""

import atexit
import fcntl
import pickle
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext, suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import IO, Any

import llvmlite
import numba
from llvmlite.binding import get_host_cpu_features, get_host_cpu_name

from mindrun.files.user_cache import user_cache
from mindrun.sim.numba_internals import made_for, packed, unpacked

SIM_FOLDER = Path(__file__).parent
SHIPPED = SIM_FOLDER / "compiled"  # in the wheel
# The kinds of processors for which wheels have machine code, and what one must have to run it, as LLVM writes it.
PROCESSORS = {"x86-64-v3": "+avx,+avx2,+bmi,+bmi2,+f16c,+fma,+lzcnt,+movbe,+popcnt,+sse4.2", "generic": "+neon"}
HASH_BYTES = 32
# Of several processes that lack the same code one compiles it, and the others wait so long. Then each compiles for
# itself: the other may be stopped, or its machine be gone while a shared disk keeps its lock.
WAIT_SECONDS = 600.0
ASK_AGAIN_SECONDS = 0.05
KINDS = "../kinds/sensors/*.py", "../kinds/functions/*.py"


@cache
def stamp() -> str:
    """A hash of all that machine code depends on but the processor: numba misses changes of callees in other files."""
    versions = f"{sys.implementation.cache_tag} {numba.__version__} {llvmlite.__version__}"
    digest = sha256(versions.encode())
    compiled = ("*.py", "lanes/*.py", "../numbers/*.py", "../graph/beginning.py", *KINDS)
    for path in sorted(path.resolve() for pattern in compiled for path in SIM_FOLDER.glob(pattern)):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def folder() -> Path:
    """The folder of machine code: in the user's cache; where that cannot be written, one of this process alone."""
    try:
        found = user_cache() / f"compiled-{stamp()}"
        found.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=found):
            return found
    except (OSError, RuntimeError):  # RuntimeError: there is no home
        found = Path(tempfile.mkdtemp(prefix="mind-"))  # never a known name: whoever can write it can run code here
        atexit.register(shutil.rmtree, found, ignore_errors=True)
        return found


class MachineCode:
    """The machine code of one function, for each signature: numba asks for it before it compiles."""

    cache_path = ""  # which numba's statistics name

    def __init__(self, function: str) -> None:
        self.function = function

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled function, or None."""
        for path in self.places(sig, target_context):
            if (data := _read(path)) is not None:
                return unpacked(pickle.loads(data), target_context)
        return None

    def places(self, sig: Any, target_context: Any) -> list[Path]:
        """The files that may have it: what is kept, then what was shipped."""
        triple, *processor = made_for(target_context.codegen())
        kept = folder() / self.file(sig, triple, *processor)
        return [kept, *(SHIPPED / self.file(sig, triple, kind, PROCESSORS[kind]) for kind in fitting())]

    def exclusive(self, sig: Any, target_context: Any) -> AbstractContextManager[None]:
        """A context to compile in: where no file is found, of one process at a time: the next finds what it made."""
        kept, *shipped = self.places(sig, target_context)
        is_found = any(path.is_file() for path in (kept, *shipped))
        return nullcontext() if is_found else exclusive(kept.with_suffix(".lock"))

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep a compiled function; where that fails, it is compiled again another time."""
        with suppress(OSError):
            _write(folder() / self.file(sig, *made_for(data.codegen)), packed(data))

    def file(self, sig: Any, triple: str, processor: str, features: str) -> str:
        """The name of the file for a signature and a target."""
        digest = sha256(f"{stamp()} {triple} {features} {sig}".encode()).hexdigest()[:16]
        return f"{self.function}-{processor}-{digest}.code"

    def is_native(self) -> bool:
        """True if some is kept that was made for this very processor."""
        return any(folder().glob(f"{self.function}-{processor()}-*.code"))

    def is_there(self) -> bool:
        """True if there is some for this processor, as far as one can see without the types."""
        shipped = (path for kind in fitting() for path in SHIPPED.glob(f"{self.function}-{kind}-*.code"))
        return self.is_native() or any(shipped)


def processor() -> str:
    """The name of this processor, as LLVM has it."""
    return str(get_host_cpu_name())


def fitting() -> list[str]:
    """The kinds of PROCESSORS whose code this one can run; none where a user wants another's code."""
    if numba.config.CPU_NAME:
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
        file.write(sha256(data).digest() + data)
    Path(file.name).replace(path)


@contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """A context that one process at a time is in for a `path`; where locking fails, or takes too long, any number are.

    A POSIX lock: it ends with its process, and processes forked meanwhile do not have it. Of threads it knows nothing.
    """
    with ExitStack() as held:
        with suppress(OSError):
            _lock(held.enter_context(path.open("ab")))
        yield


def _lock(file: IO[bytes]) -> None:
    """Wait for the lock of a file; OSError after WAIT_SECONDS."""
    patience = time.monotonic() + WAIT_SECONDS
    while True:
        try:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return
        except (BlockingIOError, PermissionError):  # both mean that another process has it
            if time.monotonic() > patience:
                raise
        time.sleep(ASK_AGAIN_SECONDS)
