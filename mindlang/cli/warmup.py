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
    from rich.text import Text

    from mindlang.cli._session import COMPILING

    had = warmup.is_native()
    if not had:
        tell(COMPILING)
        warmup.start().wait()
        if not warmup.is_native():
            fail("The simulator could not be compiled.", "python -m mindrun.sim.warmup says why")
    data = {"processor": cache.processor(), "folder": str(cache.folder()), "compiled": not had}
    done = "had been compiled" if had else "is compiled"
    print_result(as_json, data, lambda: Text(f"the simulator {done} for {cache.processor()}: {cache.folder()}"))
