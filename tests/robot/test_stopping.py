"""A signal ends a robot, whatever hangs; what ends in order is not interrupted."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from mindrun.robot.processes import stopping
from mindrun.robot.recording import read

from tests.robot.driving import MINDRUN, program, until, write_procedure

HANGS = """
calls = []
def f(sense, pulse):
    calls.append(1)
    if len(calls) == 9:
        import time
        open({path!r}, "x").close()
        while True:
            pass
    return 0.9
"""


def test_one_signal_ends_a_procedure_that_hangs(bundle: Path, tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    write_procedure(bundle, HANGS.format(path=str(tmp_path / "hangs")))
    words = (*MINDRUN, bundle, "--arm", "--record", day)
    process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    until((tmp_path / "hangs").exists, process)
    process.terminate()
    _, err = process.communicate(timeout=600)
    assert process.returncode == 130, err
    assert "Traceback" not in err
    assert [row["tick"] for rows in read(day)[1] for row in rows] == list(range(8)), "what was recorded is whole"


@pytest.mark.parametrize(("end", "code"), [("os._exit(0)", 1), ("os._exit(7)", 7)])
def test_what_ends_the_process_is_no_success(bundle: Path, end: str, code: int) -> None:
    write_procedure(bundle, f"import os\ndef f(sense, pulse):\n    {end}\n")
    assert program(bundle, "--arm").returncode == code


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_each_signal_that_ends_programs_is_heard(number: signal.Signals) -> None:
    with stopping(600.0) as stop:
        assert signal.getsignal(number) == stop.note
        os.kill(os.getpid(), number)
        assert stop


def python(lines: str) -> subprocess.CompletedProcess[str]:
    before = "import os, signal, time\nfrom mindrun.robot.processes import *\n"
    return subprocess.run([sys.executable, "-c", before + lines], capture_output=True, text=True, timeout=600)


def test_what_catches_everything_is_ended_as_it_is() -> None:
    done = python("""
with stopping(0.05) as stop:
    os.kill(os.getpid(), signal.SIGTERM)
    while True:
        try:
            time.sleep(1)
        except BaseException:
            print("caught", flush=True)
""")
    assert (done.returncode, done.stdout) == (130, "caught\n")


def test_what_ends_in_order_is_not_interrupted_but_does_not_last_for_ever() -> None:
    done = python("""
with stopping(0.5) as stop:
    os.kill(os.getpid(), signal.SIGTERM)
    assert stop
    stop.in_order()
    time.sleep(0.6)
    print("still here", flush=True)
    time.sleep(60)
""")
    assert (done.returncode, done.stdout) == (130, "still here\n")


def test_what_follows_an_interruption_is_not_interrupted_again() -> None:
    done = python("""
with stopping(0.5):
    try:
        for _ in range(2):
            os.kill(os.getpid(), signal.SIGTERM)
    except KeyboardInterrupt:
        for _ in range(3):
            os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(0.6)
        print("at neutral", flush=True)
""")
    assert (done.returncode, done.stdout) == (0, "at neutral\n"), done.stderr


def test_afterwards_signals_are_what_they_were() -> None:
    done = python("""
with stopping(0.1) as stop:
    assert not stop
    os.kill(os.getpid(), signal.SIGTERM)
    assert stop
time.sleep(0.3)
print("alive", flush=True)
os.kill(os.getpid(), signal.SIGTERM)
""")
    assert (done.returncode, done.stdout) == (-signal.SIGTERM, "alive\n")
