"""The step of an environment that a worker is at, in memory that outlives it.

The worker writes it at each step, without a call of the system; who has begun it reads that while it works, and when it
has ended.
"""

from mmap import mmap
from struct import Struct
from tempfile import TemporaryFile
from typing import Any

STEP = Struct("<?QQQH")  # whether it is at one, how many before, the seed, how many steps, the bytes of the name behind
MEMORY_BYTES = 4096
MAX_NAME_BYTES = 1024


class LastStep:
    """The memory behind a descriptor, or that of a new file without a name; or `shared`, which is memory already."""

    def __init__(self, descriptor: int | None = None, shared: Any = None) -> None:
        self._file, self._number = None, 0
        if shared is not None:
            self._memory = shared
            return
        if descriptor is None:
            self._file = TemporaryFile()  # noqa: SIM115  # it is closed below
            self._file.truncate(MEMORY_BYTES)
            descriptor = self._file.fileno()
        self.descriptor = descriptor
        self._memory = mmap(descriptor, MEMORY_BYTES)

    def write(self, environment: bytes, seed: int, steps: int) -> None:
        """It begins now; the name has MAX_NAME_BYTES at most."""
        self._number += 1
        said = STEP.pack(True, self._number, seed, steps, len(environment)) + environment
        self._memory[: len(said)] = said

    def clear(self) -> None:
        """It has ended."""
        self._memory[:1] = b"\0"

    def asked(self) -> tuple[int, str, str] | None:
        """The step that goes on: its number among all, where in which run that is, in words, and the environment."""
        is_open, number, seed, steps, length = STEP.unpack_from(self._memory)
        return (number, place_of(seed, steps), self._name(length)) if is_open else None

    def read(self) -> tuple[str, str] | None:
        """When in which run that was, in words, and the environment; None where it has been at none.

        After a step where it has ended: who kills its process from another thread, or by a signal, may come so late.
        """
        is_open, _, seed, steps, length = STEP.unpack_from(self._memory)
        return (f"{'in' if is_open else 'after'} {place_of(seed, steps)}", self._name(length)) if length else None

    def close(self) -> None:
        """Give the memory back."""
        self._memory.close()
        if self._file is not None:
            self._file.close()

    def _name(self, length: int) -> str:
        name: bytes = self._memory[STEP.size : STEP.size + min(length, MAX_NAME_BYTES)]
        return name.decode(errors="replace")


def place_of(seed: int, steps: int) -> str:
    """Where in a run something was, in words."""
    return f"step {steps} of the run of seed {seed}" if steps else f"the beginning of the run of seed {seed}"
