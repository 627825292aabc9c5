"""A process that gives way: its niceness, and that of its session, which counts first where the system has it so."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import os
from pathlib import Path
from mindrun.processors import give_way
before = os.nice(0)
give_way(7)
print(os.nice(0) - before, Path("/proc/self/autogroup").read_text())
"""
SESSIONS = Path("/proc/self/autogroup")

pytestmark = pytest.mark.skipif(not os.access(SESSIONS, os.W_OK), reason="sessions have no niceness of their own here")


@pytest.mark.parametrize("alone", [True, False])
def test_only_a_session_of_its_own_gives_way_as_a_whole(alone: bool) -> None:
    command = [sys.executable, "-c", PROGRAM]
    own, *session = subprocess.check_output(command, text=True, start_new_session=alone).split()
    assert own == "7"
    # "/autogroup-25 nice 0", and nothing at all for the session that the system itself began.
    assert session[2:] == (["7"] if alone else SESSIONS.read_text(encoding="ascii").split()[2:])
