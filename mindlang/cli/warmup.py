"""`mindc warmup`: what the first start would wait for, done now.

Examples:
  mindc warmup          in an image, or on each kind of machine of a cluster
  mindc warmup --json
"""

import click

from mindlang.cli._options import json_flag
from mindlang.cli._terminal import fail, print_result, tell


@click.command
@json_flag("One JSON document instead: mindc warmup --json")
def command() -> None:
    """Compile the simulator for this very processor, now.

    Otherwise the first lesson, run or bench does it, or waits for it. What is compiled is kept in the user's cache
    (NUMBA_CACHE_DIR, XDG_CACHE_HOME or ~/.cache), for this processor and these versions of mindc and Python.
    """
    from mindrun.sim import cache, warmup
    from mindrun.sim.compilation import compile_natively
    from mindrun.sim.machine_code import target
    from rich.text import Text

    from mindlang.cli._session import COMPILING_ALL, counting

    missing = [each for each in warmup.every_unit() if not cache.is_native(each)]
    if missing:
        tell(COMPILING_ALL)
        with counting("compiling", len(missing)) as told:
            compile_natively(missing, lambda: told(1))
        if not all(map(cache.is_native, missing)):
            fail("The simulator could not be compiled.", "python -m mindrun.sim.warmup says why")
    had, processor = not missing, target().processor
    data = {"processor": processor, "folder": str(cache.folder()), "compiled": not had}
    done = "had been compiled" if had else "is compiled"
    print_result(data, lambda: Text(f"the simulator {done} for {processor}: {cache.folder()}"))
