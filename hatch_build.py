"""Wheels with the simulator's machine code, where MIND_COMPILED is set: `make wheel`.

It has every unit, for the kind of processors of which this one is (`mindrun.sim.cache`), this Python and the installed
numba.
"""

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class CustomBuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """Called by hatchling for every build."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the machine code to a wheel that is none for working on the sources."""
        if version == "standard" and os.environ.get("MIND_COMPILED"):
            self.place = TemporaryDirectory(prefix="mind-wheel-")  # until the wheel is made
            for path in _compiled(Path(self.root), self.place.name):
                build_data["force_include"][str(path)] = f"mindrun/sim/compiled/{path.name}"
            build_data["pure_python"], build_data["infer_tag"] = False, True


def _compiled(root: Path, place: str) -> list[Path]:
    """The files of machine code, made in a folder."""
    sys.path.insert(0, str(root / "runtime"))
    from mindrun.sim import cache

    kind = cache.fitting()[0]
    settings = {"NUMBA_CPU_NAME": kind, "NUMBA_CPU_FEATURES": cache.PROCESSORS[kind], "NUMBA_CACHE_DIR": place}
    environment = os.environ | settings | {"PYTHONPATH": str(root / "runtime")}
    subprocess.run([sys.executable, "-P", "-m", "mindrun.sim.warmup"], env=environment, check=True)
    return sorted(Path(place).glob("*/*.code"))
