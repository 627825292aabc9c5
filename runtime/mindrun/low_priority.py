"""A process that gives way to all others: of the processor, and of memory where there is too little for all."""

import os
from contextlib import suppress
from pathlib import Path

FIRST_TO_BE_KILLED = "1000"  # oom_score_adj: the most there is


def give_way(niceness: int) -> None:
    """As far as the system can, with this much more niceness."""
    os.nice(niceness)
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text(FIRST_TO_BE_KILLED, encoding="ascii")
    # Linux shares the processor between sessions first: among the processes of its own alone, one gives way to nobody.
    if os.getsid(0) == os.getpid():
        with suppress(OSError):
            Path("/proc/self/autogroup").write_text(str(niceness), encoding="ascii")
