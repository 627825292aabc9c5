"""`mindc warmup`: what the first start would wait for, done now."""

import click

from mindlang.cli._terminal import fail, print_result, tell

EXAMPLES = """\b
Examples:
  mindc warmup          in an image, or on each kind of machine of a cluster
  mindc warmup --json
"""


@click.command(epilog=EXAMPLES)
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc warmup --json")
def command(as_json: bool) -> None:
    """Compile the simulator for this very processor, now.

    Otherwise the first lesson, run or bench does it, or waits for it. What is compiled is kept in the user's cache
    (NUMBA_CACHE_DIR, XDG_CACHE_HOME or ~/.cache), for this processor and these versions of mindc and Python.
    """
    from mindrun.sim import cache, warmup
    from mindrun.sim.compilation import compile_natively
    from mindrun.sim.machine_code import target
    from rich.text import Text

    from mindlang.cli._session import COMPILING_ALL, progress

    missing = [each for each in warmup.every_unit() if not cache.is_native(each)]
    if missing:
        tell(COMPILING_ALL)
        with progress(hidden=False) as bar:
            part = bar.add_task("compiling", total=len(missing))
            compile_natively(missing, lambda: bar.advance(part))
        if not all(map(cache.is_native, missing)):
            fail("The simulator could not be compiled.", "python -m mindrun.sim.warmup says why")
    had, processor = not missing, target().processor
    data = {"processor": processor, "folder": str(cache.folder()), "compiled": not had}
    done = "had been compiled" if had else "is compiled"
    print_result(as_json, data, lambda: Text(f"the simulator {done} for {processor}: {cache.folder()}"))
