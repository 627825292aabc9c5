"""The checks of `mindc doctor`: one function each, in the order in which they are told.

Packages are imported where they are checked, so that one that is broken hides no other check.
"""

import os
import platform
import sys
import webbrowser
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, metadata, requires, version
from pathlib import Path
from typing import Literal

import mindrun
from mindrun.kinds.registry import brought_by, kinds, refused_packages
from mindrun.processors import cores
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

import mindlang
from mindlang import limits

SMALL_MEMORY_BYTES = 512 << 20  # below which compiling the simulator may fail
LISTED_PACKAGES = 3  # of an extra; of more only their number is told


@dataclass(frozen=True, slots=True)
class DoctorFinding:
    """One thing that was looked at: how it is, what was seen, and the line that mends it, where it is not ok.

    Nothing is wrong with what is absent: it is needed only for what is said of it.
    """

    what: str
    state: Literal["ok", "absent", "wrong"]
    seen: str
    mend: str = ""


def findings() -> Iterator[DoctorFinding]:
    """All that the checks have seen. One that fails is itself a finding: a broken package must not hide the others."""
    for check in CHECKS:
        try:
            yield from check()
        except Exception as error:
            name = check.__name__.replace("_", " ")
            yield DoctorFinding(name, "wrong", f"{type(error).__name__}: {error}".split("\n")[0])


def programs() -> Iterator[DoctorFinding]:
    """mindc and mindrun: which they are, and that both are of one version."""
    place = Path(mindlang.__file__).parent
    known = _version("mindlang")
    if known is None:
        yield DoctorFinding("mindc", "wrong", f"in {place}, not installed as a package", "pip install .")
    else:
        yield DoctorFinding("mindc", "ok", f"{known}, in {place}")
    runtime = f"{mindrun.VERSION}, in {Path(mindrun.__file__).parent}"
    if known and known != mindrun.VERSION:
        mend = "pip uninstall mindrun mindlang, then pip install mindlang, which brings mindrun along"
        yield DoctorFinding("mindrun", "wrong", f"{runtime}; mindc is {known}", mend)
    elif _version("mindrun") is not None:
        yield DoctorFinding("mindrun", "wrong", f"{runtime}, and installed by itself as well", "pip uninstall mindrun")
    else:
        yield DoctorFinding("mindrun", "ok", runtime)


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def python() -> Iterator[DoctorFinding]:
    """A version of Python for which mind is made."""
    bounds, found = SpecifierSet(metadata("mindlang")["Requires-Python"] or ""), platform.python_version()
    if bounds.contains(found, prereleases=True):
        yield DoctorFinding("Python", "ok", f"{found}, {sys.executable}")
    else:
        mend = f"python3 -m venv .venv with a Python {bounds}, and install mind there"
        yield DoctorFinding("Python", "wrong", f"{found}, and mind is made for {bounds}", mend)


def machine() -> Iterator[DoctorFinding]:
    """The processor, how many cores this process may use, and how much memory is free."""
    all_cores, usable = os.cpu_count() or 1, cores()
    words = f"{usable} cores" if usable == all_cores else f"{usable} of {all_cores} cores"
    yield DoctorFinding("machine", "ok", f"{platform.machine()}, {platform.system()}, {words} to use")
    free = limits.available()
    if free is None:
        yield DoctorFinding("memory", "absent", "nobody knows how much is free", "nothing to do: it is not limited")
    elif free < SMALL_MEMORY_BYTES:
        mend = "end other programs: compiling the simulator takes about 500 MiB"
        yield DoctorFinding("memory", "wrong", f"{free >> 20} MiB free", mend)
    else:
        yield DoctorFinding("memory", "ok", f"{free / 2**30:.1f} GiB free")


def packages() -> Iterator[DoctorFinding]:
    """The packages without which nothing runs, each in a version that is known."""
    for each in requirements():
        found = _version(each.name)
        if _is_met(each):
            yield DoctorFinding(each.name, "ok", f"{found}")
        else:
            seen = f"{found}, and {each.specifier} is needed" if found else "not installed"
            yield DoctorFinding(each.name, "wrong", seen, f"pip install '{each.name}{each.specifier}'")


def requirements(extra: str = "") -> list[Requirement]:
    """The packages that an extra needs beyond those always needed, or the latter."""

    def is_for(package: Requirement, extra: str) -> bool:
        return package.marker is None or package.marker.evaluate({"extra": extra})

    found = map(Requirement, requires("mindlang") or ())
    return [each for each in found if is_for(each, extra) and not (extra and is_for(each, ""))]


def _is_met(package: Requirement) -> bool:
    found = _version(package.name)
    return found is not None and package.specifier.contains(found, prereleases=True)


def machine_code() -> Iterator[DoctorFinding]:
    """The simulator's machine code: its folder, and whether it is there."""
    from mindrun.sim import cache, warmup
    from mindrun.sim.machine_code import target

    folder, units = cache.folder(), warmup.every_unit()
    if cache.lasts():
        size = sum(path.stat().st_size for path in folder.glob("*") if path.is_file())
        yield DoctorFinding("compiler cache", "ok", f"{size >> 20} MiB in {folder}")
    else:
        mend = "let XDG_CACHE_HOME name a folder that can be written"
        yield DoctorFinding("compiler cache", "wrong", "no folder can be written: every start compiles anew", mend)
    if all(map(cache.is_native, units)):
        yield DoctorFinding("simulator", "ok", f"compiled for {target().processor}")
    elif not cache.missing(units):
        seen = "shipped for any processor of this kind; made for this one while the first lesson runs"
        yield DoctorFinding("simulator", "ok", seen)
    else:
        seen = "not all compiled yet: a lesson, run or bench does it when it needs more, in some ten seconds"
        yield DoctorFinding("simulator", "absent", seen, "mindc warmup")


def physics() -> Iterator[DoctorFinding]:
    """Contacts, which the simulator makes as Chipmunk would: held against pymunk, where they are compiled."""
    from mindrun.sim import cache

    from mindlang import physics_check as check

    by = f"pymunk {_version('pymunk')}"
    if cache.missing(check.world().units()):
        yield DoctorFinding("physics", "absent", f"not held against {by}: not compiled yet", "mindc warmup")
    elif tick := check.differing_tick(check.PUSHING_SEED):
        seen = f"not as {by} has it from tick {tick} on: what is taught elsewhere may do something else here"
        yield DoctorFinding("physics", "wrong", seen, "tell us, with what mindc doctor prints")
    else:
        yield DoctorFinding(
            "physics", "ok", f"{check.RUN_TICKS} ticks of boxes that are pushed: as {by} has it, to the bit"
        )


def viewer() -> Iterator[DoctorFinding]:
    """The page of `mindc view`, which is built before a package is made."""
    page = Path(mindlang.__file__).parent / "view" / "page" / "index.html"
    if page.is_file():
        yield DoctorFinding("viewer", "ok", "its page is there")
    else:
        yield DoctorFinding("viewer", "wrong", f"{page} is missing", "cd viewer && npm ci && npm run build")


def browser() -> Iterator[DoctorFinding]:
    """A browser, which `mindc view` opens where there is one."""
    try:
        found = webbrowser.get()
    except webbrowser.Error:
        mend = "open the address that mindc view prints, from any machine that reaches it"
        yield DoctorFinding("browser", "absent", "none found", mend)
    else:
        yield DoctorFinding("browser", "ok", str(getattr(found, "name", "found")))


def extra_packages() -> Iterator[DoctorFinding]:
    """The extras, which not everybody needs."""
    for extra in extras():
        needed = requirements(extra)
        missing = [
            f"{each.name}{each.specifier if _version(each.name) else ''}" for each in needed if not _is_met(each)
        ]
        if missing:
            seen = f"without {', '.join(missing)}"
            yield DoctorFinding(f"[{extra}]", "absent", seen, f"pip install 'mindlang[{extra}]'")
        elif len(needed) > LISTED_PACKAGES:
            yield DoctorFinding(f"[{extra}]", "ok", f"all {len(needed)} packages")
        else:
            yield DoctorFinding(f"[{extra}]", "ok", ", ".join(f"{each.name} {_version(each.name)}" for each in needed))


def extras() -> list[str]:
    """The extras of the installed mindlang by name."""
    return metadata("mindlang").get_all("Provides-Extra") or []


def kind_packages() -> Iterator[DoctorFinding]:
    """The packages that bring functions of skills."""
    refused, skills = refused_packages(), kinds("skill").items()
    brought = [(found[0], name) for name, cls in skills if (found := brought_by(cls))]
    for package, name in brought:
        yield DoctorFinding(name, "ok", f"a function of {package}")
    for package, why in refused.items():
        yield DoctorFinding(package, "wrong", f"its kinds cannot be used: {why}", "mend or uninstall it")


CHECKS = (programs, python, machine, packages, kind_packages, machine_code, physics, viewer, browser, extra_packages)
