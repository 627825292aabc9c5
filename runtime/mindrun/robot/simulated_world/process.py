"""A simulated world in a process of its own, begun and ended."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from mindrun.errors import MindError
from mindrun.robot.simulated_world.server import NEUTRAL_SECONDS


@contextmanager
def simulated(
    bundle: Path, task: str, seed: int, speed: float = 1.0, *, again: bool = False, master: str = ""
) -> Iterator[str]:
    """The socket of a world that lives in a process of its own for as long as this lasts; MindError if it cannot.

    Where numba has to compile first, that takes a minute. The world also ends with the thread that called this.
    """
    with TemporaryDirectory(prefix="mind-") as folder:
        path = f"{folder}/world"
        # -P: a file of the user's folder that is named like a module must not be imported.
        program = [sys.executable, "-P", "-m", "mindrun.robot.simulated_world", f"--task={task}", f"--seed={seed}"]
        program += [f"--speed={speed}", f"--master={master}", f"--socket={path}", *["--again"] * again]
        program += ["--", str(bundle)]
        # A session of its own: Ctrl-C ends the robot, and the guardian still finds the wheels that it stops.
        with subprocess.Popen(program, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
            assert process.stdout
            try:
                said = process.stdout.readline().strip()
                if said != "ready":
                    raise MindError(said or "the simulated world ended before it was ready")
                yield path
            finally:
                process.terminate()
                try:
                    process.wait(2 * NEUTRAL_SECONDS)
                except subprocess.TimeoutExpired:
                    process.kill()
