"""What a controller says is no part of what it does: nobody has to listen, and no terminal obeys a name."""

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from mindrun.robot.recording import read
from mindrun.terminal.standard_streams import LineWriter

from tests.robot.driving import MINDRUN, begun, children, mindrun, program, until, write_procedure

TALKS = """
import sys
def f(sense, pulse):
    print("x" * 5000)
    print("y" * 5000, file=sys.stderr)
    return 0.9
"""
FAILS = TALKS.replace("return 0.9", "calls.append(1)\n    return 0.9 / (len(calls) < 9)\ncalls = []")


@pytest.fixture(params=["nobody reads", "reader gone", "full", "closed"])
def deaf(request: pytest.FixtureRequest) -> Iterator[int | None]:
    """Where standard error goes."""
    reading, writing = os.pipe()
    match request.param:
        case "reader gone":
            os.close(reading)
            reading = os.open(os.devnull, os.O_RDONLY)
        case "full":
            os.close(writing)
            writing = os.open("/dev/full", os.O_WRONLY)
    try:
        yield None if request.param == "closed" else writing
    finally:
        os.close(reading)
        os.close(writing)


def test_it_drives_on_where_nobody_listens(bundle: Path, tmp_path: Path, deaf: int | None) -> None:
    write_procedure(bundle, TALKS)
    day, words = tmp_path / "day.rec", ("--arm", "--ticks", 15, "--record", tmp_path / "day.rec")
    if deaf is None:
        line = " ".join(map(str, (*MINDRUN, bundle, *words, ">&- 2>&-")))
        assert subprocess.run(["sh", "-c", line], timeout=600).returncode == 0
    else:
        assert program(bundle, *words, stderr=deaf).returncode == 0
    rows = np.concatenate(list(read(day)[1]))
    assert list(rows["tick"]) == list(range(15))


def test_a_signal_ends_it_where_nobody_listens(bundle: Path, tmp_path: Path) -> None:
    write_procedure(bundle, TALKS)
    reading, writing = os.pipe()
    process = begun(bundle, tmp_path / "day.rec", stderr=writing, stdout=writing)
    (guardian,) = children(process.pid, "guardian")
    process.terminate()
    assert process.wait(60) == 0
    until(lambda: not Path(f"/proc/{guardian}").exists())
    os.close(reading)
    os.close(writing)


def test_an_error_ends_it_where_nobody_listens(bundle: Path, tmp_path: Path) -> None:
    write_procedure(bundle, FAILS)
    reading, writing = os.pipe()
    assert program(bundle, "--arm", stderr=writing, stdout=writing).returncode == 1
    os.close(reading)
    os.close(writing)


def test_who_listens_hears_all_of_it(bundle: Path) -> None:
    write_procedure(bundle, FAILS)
    said = program(bundle, "--arm")
    assert said.returncode == 1
    assert said.stdout == ""
    assert (said.stderr.count("x" * 5000), said.stderr.count("y" * 5000)) == (9, 9)
    assert "ZeroDivisionError" in said.stderr


def test_standard_output_need_not_be_there(bundle: Path) -> None:
    line = f"exec {' '.join(MINDRUN)} {bundle} --arm --ticks 5 >&-"
    said = subprocess.run(["sh", "-c", line], capture_output=True, text=True, timeout=600)
    assert said.returncode == 0
    assert "5 ticks" in said.stderr
    said = subprocess.run(["sh", "-c", f"{' '.join(MINDRUN)} doctor >&-"], capture_output=True, text=True, timeout=600)
    assert said.stderr == "mindrun: standard output cannot be written: it is closed\n"


def test_a_reader_that_comes_back_is_told_what_is_new() -> None:
    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    while True:
        try:
            os.write(writing, b"x" * 4096)
        except BlockingIOError:
            break
    tell = LineWriter(writing, "guardian: ")
    for number in range(5000):
        tell(f"line {number}")
    tell.drain(0.1)
    tell("the last\x1b[2J")
    heard = b""
    while not heard.endswith(b"the last\\u001b[2J\n"):
        heard += os.read(reading, 1 << 16)
    assert b"guardian: line 4999\n" in heard
    tell.drain(20)
    os.close(writing)
    os.close(reading)


NASTY = "left\x1b[2J\x9b\u202e"


def test_no_terminal_obeys_a_name(bundle: Path, tmp_path: Path) -> None:
    readings = tmp_path / "log.jsonl"
    readings.write_text('{"a\\u001b[2J\\u009b": 1}\n')
    for called, *words in (
        (program, bundle, "--readings", readings),
        (mindrun, bundle, "--master", NASTY),
        (mindrun, NASTY),
        (mindrun, "calibrate", bundle, NASTY),
        (mindrun, bundle, "--task", NASTY, "--dry"),
        (program, bundle, f"--{NASTY}"),
    ):
        said = called(*words)
        assert said.returncode == 2
        assert not set(said.stdout + said.stderr) & set("\x1b\x9b\u202e")
        assert "\\u001b[2J" in said.stderr


def test_a_bundle_whose_names_cannot_be_printed_is_none(bundle: Path) -> None:
    from dataclasses import replace

    from mindrun.graph.validate import graph_flaw

    from tests.robot.faults import graph

    fine = graph("bearing")
    first, *others = fine.actuators
    for name in ("wheel\x1b[2J", "wheel\n", "\u202e", ""):
        found = graph_flaw(replace(fine, actuators=(replace(first, name=name), *others)))
        assert found
        assert found.isprintable()
