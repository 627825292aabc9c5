"""The simulator's machine code: where it is kept, whether that can be written, and whether any is there."""

from collections.abc import Iterator
from pathlib import Path

from mindrun.sim import cache, warmup
from mindrun.sim.lanes.advance import advance

from mindlang.diagnosis.finding import Finding, State

SEVERAL_BYTES = 200 << 20  # of older versions, from which on they are told


def check() -> Iterator[Finding]:
    """One finding of the folder, one of what is in it, one of what older versions left."""
    folder = cache.folder()
    is_kept = folder.name == f"compiled-{cache.stamp()}"
    if is_kept:
        yield Finding("compiler cache", State.FINE, f"{_mebibytes(folder)} MiB in {folder}")
    else:
        mend = "let XDG_CACHE_HOME name a folder that can be written"
        yield Finding("compiler cache", State.WRONG, "no folder can be written: every start compiles anew", mend)
    if warmup.is_native():
        yield Finding("simulator", State.FINE, f"compiled for {cache.processor()}")
    elif warmup.is_there((advance,)):
        seen = "shipped for any processor of this kind; made for this one while the first lesson runs"
        yield Finding("simulator", State.FINE, seen)
    else:
        seen = "not compiled yet: the first lesson, run or bench does it, in about a minute"
        yield Finding("simulator", State.ABSENT, seen, "mindc warmup")
    older = sum(_mebibytes(each) for each in folder.parent.glob("compiled-*") if each != folder) if is_kept else 0
    if older << 20 > SEVERAL_BYTES:
        mend = f"if you use no older version any more: rm -r {folder.parent}/compiled-*, then mindc warmup"
        yield Finding("older caches", State.ABSENT, f"{older} MiB of other versions in {folder.parent}", mend)


def _mebibytes(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.glob("*") if path.is_file()) >> 20
