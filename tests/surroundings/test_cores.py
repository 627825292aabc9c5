"""How many cores there are: what a container's control groups allow, wherever in their tree it is said."""

import os
import subprocess
import sys
from collections.abc import Sequence
from math import ceil
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun import processors
from mindrun.processors import cores, cpu_seconds

from mindlang.diagnosis import machine

CORES = 64
LIMITS = st.one_of(st.none(), st.integers(1, 3 * CORES).map(lambda tenths: tenths / 10))  # None is no limit
V2, V1, JOINED = "unified", "cpu", "cpu,cpuacct"


def write(root: Path, version: str, inside: str, limits: Sequence[float | None], is_namespaced: bool) -> None:
    """Groups one in another, the first of which is the root; a namespaced container sees its own at the root."""
    lines = {V2: f"0::/{inside}", V1: f"4:cpu:/{inside}", JOINED: f"3:memory:/\n4:cpu,cpuacct:/{inside}\n0::/"}
    (root / "proc/self").mkdir(parents=True)
    (root / "proc/self/cgroup").write_text(lines[version] + "\n")
    group = root / "sys/fs/cgroup" / ("" if version == V2 else version)
    names = [""] if is_namespaced else ["", *filter(None, inside.split("/"))]
    for name, limit in zip(names, limits, strict=False):
        group /= name
        group.mkdir(parents=True, exist_ok=True)
        if version == V2:
            (group / "cpu.max").write_text(f"{'max' if limit is None else round(limit * 50_000)} 50000\n")
        else:
            (group / "cpu.cfs_quota_us").write_text(f"{-1 if limit is None else round(limit * 50_000)}\n")
            (group / "cpu.cfs_period_us").write_text("50000\n")


@given(
    st.sampled_from([V2, V1, JOINED]),
    st.sampled_from(["", "docker/1f", "a.slice/b.slice/c.scope"]),
    st.lists(LIMITS, min_size=4, max_size=4),
    st.booleans(),
)
def test_the_least_of_all_groups(version: str, inside: str, limits: list[float | None], is_namespaced: bool) -> None:
    depth = 1 if is_namespaced or not inside else 1 + len(inside.split("/"))
    least = min((ceil(each) for each in limits[:depth] if each is not None), default=CORES)
    with TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "sched_getaffinity", lambda _: {*range(CORES)}, raising=False)
        write(Path(folder), version, inside, limits, is_namespaced)
        assert cores(Path(folder)) == min(CORES, least)


def test_where_nothing_is_said_those_that_it_may_run_on_count(tmp_path: Path) -> None:
    assert cores(tmp_path) == len(os.sched_getaffinity(0))


def test_all_who_count_ask_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, V2, "", [1.0], True)
    monkeypatch.setattr(processors, "ROOT", tmp_path)
    assert cores(tmp_path) == 1
    assert next(iter(machine())).seen.endswith((f" 1 of {os.cpu_count()} cores to use", " 1 cores to use"))


def test_the_time_of_processors_is_that_of_all_who_work_for_us() -> None:
    """Of threads, of a child that is there, and still of that when it has ended."""
    before = cpu_seconds()
    spin = "import time\nwhile time.process_time() < 0.3: pass\nprint(flush=True)\ninput()"
    child = subprocess.Popen([sys.executable, "-c", spin], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdout
    child.stdout.readline()
    working = cpu_seconds() - before
    assert working >= 0.25
    child.communicate(b"\n")
    assert cpu_seconds() - before >= 0.25
