"""The machine: its processor, how many cores this process may use, and how much memory is free."""

import os
import platform
from collections.abc import Iterator

from mindrun.cores import cores

from mindlang import resource_limits
from mindlang.diagnosis.finding import Finding, State

SMALL_MEMORY_BYTES = 512 << 20  # below which compiling the simulator may fail


def check() -> Iterator[Finding]:
    """Cores and memory."""
    all_cores = os.cpu_count() or 1
    usable = cores()
    words = f"{usable} cores" if usable == all_cores else f"{usable} of {all_cores} cores"
    yield Finding("machine", State.FINE, f"{platform.machine()}, {platform.system()}, {words} to use")
    free = resource_limits.available()
    if free is None:
        yield Finding("memory", State.ABSENT, "nobody knows how much is free", "nothing to do: it is not limited")
    elif free < SMALL_MEMORY_BYTES:
        mend = "end other programs: compiling the simulator takes about 500 MiB"
        yield Finding("memory", State.WRONG, f"{free >> 20} MiB free", mend)
    else:
        yield Finding("memory", State.FINE, f"{free / 2**30:.1f} GiB free")
