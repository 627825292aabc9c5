"""A process that has imported mindc, and becomes it: a command of a page need not import all of that anew.

The program `mindc` of a page's reader (`CLIENT`) hands its words, its folder, its environment and its streams over.
"""

import json
import os
import socket
import sys
from importlib import import_module
from typing import NoReturn

ADDRESS = "MIND_SERVER"  # the variable that says where the server listens
READY = "ready\n"
IMPORTED = ("_session", "_trainer", "bench", "build", "check", "edit", "run", "show", "train", "why")
CLIENT = f"""\
import json, os, socket, sys
with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as server:
    server.connect(os.environ["{ADDRESS}"])
    socket.send_fds(server, [json.dumps([sys.argv[1:], os.getcwd(), dict(os.environ)]).encode()], [0, 1, 2])
    sys.exit(int(server.recv(16) or 1))
"""
MESSAGE_BYTES = 1 << 17


def serve(address: str) -> None:
    """Become mindc for everybody who asks, in a process each."""
    for name in IMPORTED:
        import_module(f"mindlang.cli.{name}")
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listening:
        listening.bind(address)
        listening.listen()
        print(READY, end="", flush=True)
        while True:
            asking, _ = listening.accept()
            with asking:
                message, streams, _, _ = socket.recv_fds(asking, MESSAGE_BYTES, 3)
                if os.fork() == 0:
                    listening.close()
                    _become(asking, streams, *json.loads(message))
                for stream in streams:
                    os.close(stream)
            while any(_ended()):
                pass


def _ended() -> tuple[int, int]:
    try:
        return os.waitpid(-1, os.WNOHANG)
    except ChildProcessError:
        return 0, 0


def _become(
    asking: socket.socket, streams: list[int], words: list[str], folder: str, environment: dict[str, str]
) -> NoReturn:
    from mindlang.cli import main

    code: object = 1
    try:
        for number, stream in enumerate(streams):
            os.dup2(stream, number)
            os.close(stream)
        os.chdir(folder)
        os.environ.clear()
        os.environ.update(environment)
        sys.argv = ["mindc", *words]
        main()
    except SystemExit as stop:
        code = stop.code
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        asking.send(str(code).encode())
        os._exit(0)
