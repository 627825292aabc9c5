"""`--on ssh:a,b` with machines that are this one: an ssh server of asyncssh, to which ~/.ssh/config leads."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("distributed", reason="distributed is not installed: pip install 'mindlang[cluster]'")
pytest.importorskip("asyncssh", reason="asyncssh is not installed: pip install 'mindlang[cluster]'")

import asyncssh

from mindlang.executors.ssh import Machine, arguments, machines
from tests.calling import Call
from tests.executors.test_on import TAUGHT, weights

ROOT = Path(__file__).parents[2]
SERVER = """
import asyncio, os, sys
import asyncssh

async def handle(process):
    with open("asked.log", "a") as log:
        log.write(process.command + "\\n")
    child = await asyncio.create_subprocess_shell(
        process.command, stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
        start_new_session=True)
    await process.redirect(stdin=child.stdin, stdout=child.stdout, stderr=child.stderr)
    ended = await child.wait()
    await asyncio.gather(process.stdout.drain(), process.stderr.drain())  # what it has said goes first
    process.exit(ended)

async def main():
    server = await asyncssh.listen("127.0.0.1", 0, server_host_keys=["host"], authorized_client_keys="id.pub",
                                   process_factory=handle, encoding=None)
    print(server.sockets[0].getsockname()[1], flush=True)
    await asyncio.to_thread(sys.stdin.read)

asyncio.run(main())
"""


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The home folder here, and of all machines."""
    folder = tmp_path / "home"
    (folder / ".ssh").mkdir(parents=True)
    for name in ("host", "id"):
        key = asyncssh.generate_private_key("ssh-ed25519")
        key.write_private_key(f"{folder / name}")
        key.write_public_key(f"{folder / name}.pub")
    (folder / "server.py").write_text(SERVER)
    path = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
    cache = os.environ.get("XDG_CACHE_HOME") or f"{Path.home() / '.cache'}"  # else each compiles
    for name, value in {"PYTHONPATH": path, "HOME": f"{folder}", "XDG_CACHE_HOME": cache}.items():
        monkeypatch.setenv(name, value)
    with subprocess.Popen(
        [sys.executable, "server.py"], cwd=folder, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as server:
        assert server.stdin
        assert server.stdout
        port = int(server.stdout.readline())
        (folder / ".ssh" / "config").write_text(
            f"Host a b\n  HostName 127.0.0.1\n  Port {port}\n  IdentityFile {folder / 'id'}\n"
            "Host gone\n  HostName 127.0.0.1\n  Port 9\n"
        )
        (folder / ".ssh" / "known_hosts").write_text(f"[127.0.0.1]:{port} {(folder / 'host.pub').read_text()}")
        yield folder
        server.stdin.close()


@pytest.mark.slow
def test_it_teaches_the_weights_of_threads_and_leaves_nothing_there(mindc: Call, tmp_path: Path, home: Path) -> None:
    expected = weights(mindc, tmp_path / "threads")
    assert weights(mindc, tmp_path / "there", "--on", f"ssh:a:{sys.executable},b,gone") == expected
    asked = (home / "asked.log").read_text()
    assert asked.count("distributed.cli.dask_spec") == 3  # a scheduler and two workers
    assert "PRIVATE KEY" not in asked
    assert [*home.glob(".mindc*")] == []


def test_where_no_machine_takes_part_it_is_one_sentence(mindc: Call, drive: Path, home: Path) -> None:
    (home / "python").write_text(f'#!/bin/sh\ntest "$1" = -c && exec {sys.executable} "$@"\n')
    (home / "python").chmod(0o755)
    for where, words in (
        ("ssh:gone", "no machine takes part; the last, gone: "),
        ("ssh:a:/nowhere/python", "no machine takes part; the last, a: /bin/sh: 1: /nowhere/python: not found"),
        (f"ssh:a:{home / 'python'}", "no cluster begins at a: "),
    ):
        done = mindc("train", *TAUGHT, "--on", where)
        said = " ".join(done.err.split())
        assert (done.code, words in said, "--resume" in said) == (1, True, True), done.err
        assert [*home.glob(".mindc*")] == [], "nor does it leave its certificate there"


def test_what_stands_in_a_list_of_machines() -> None:
    one, other = machines("me@a:~/mind/bin/python,b")
    assert (one, other) == (Machine("a", "me", "~/mind/bin/python"), Machine("b"))
    told = arguments([one, other])
    assert told["hosts"] == ["a", "a", "b"]
    assert told["remote_python"] == ["~/mind/bin/python", "~/mind/bin/python", sys.executable]
    assert [each.get("username") for each in told["connect_options"]] == ["me", "me", None]
