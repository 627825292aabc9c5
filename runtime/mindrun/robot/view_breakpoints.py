"""Breakpoints of a robot's page: looked at before it starts, by `mindc check` of mindlang, which is not imported."""

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path


def mistakes(breaks: Path, bundle: Path, task: str | None, master: str | None) -> list[str]:
    """The lines that mindc has to say of the file where something is wrong in it; `task` is that of a dry run.

    Nothing where mindlang is not installed: then the page is served elsewhere, and the file is looked at there.
    """
    if not find_spec("mindlang"):
        return []
    for path, suffix in ((breaks, ".break"), (bundle, ".bundle")):
        if path.suffix != suffix:
            return [f"{path} must end in {suffix}: mindc knows by that what it is"]
    options = [*(("--task", task) if task else ()), *(("--master", master) if master else ())]
    # -P: a file of the user's folder that is named like a module must not be imported.
    command = [sys.executable, "-P", "-c", "from mindlang.cli import main; main()", "check", *options]
    done = subprocess.run(
        [*command, "--", str(breaks), str(bundle)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    if not done.returncode:
        return []
    return (done.stderr.rstrip() or f"{breaks} cannot be looked at: mindc ended with {done.returncode}").split("\n")
