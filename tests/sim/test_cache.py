"""Machine code between starts: whole, of these sources, versions and processor, or made anew."""

import hashlib
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from shutil import copy
from types import SimpleNamespace
from typing import Any

import pytest
from mindrun.sim import cache, compilation, dependencies
from mindrun.sim.machine_code import Target, target
from mindrun.sim.warmup import every_unit

import mindlang.cli._session as simulator
from tests.calling import Call
from tests.language.examples import ROOT
from tests.sim.conftest import Write

TWICE = """
@unit
def twice(x: float) -> float:
    return x * 2
"""


def starts(write: Write) -> bool:
    """True if a unit does what it should, as at the start of a process."""
    return bool(write(TWICE).twice(10.5) == 21)


def test_what_was_compiled_is_found_at_the_next_start(place: Path, write: Write, made: list[str]) -> None:
    assert starts(write)
    assert starts(write)
    assert made == ["written.twice"]
    (kept,) = place.glob("*.code")
    assert kept.name.startswith(f"written.twice-{target().processor}-")


@pytest.mark.parametrize(
    "damage", [lambda data: data[:-1], lambda data: b"", lambda data: data[:50] + b"?" + data[51:]]
)
def test_what_is_damaged_is_made_anew(
    place: Path, write: Write, made: list[str], damage: Callable[[bytes], bytes]
) -> None:
    assert starts(write)
    (kept,) = place.glob("*.code")
    kept.write_bytes(damage(kept.read_bytes()))
    unit = write(TWICE).twice
    assert not cache.is_native(unit)
    cache.make_missing([unit])
    assert cache.is_native(unit)
    assert starts(write)
    assert made == ["written.twice"] * 2


LANES = '''
"""Lanes."""

FACTOR = 3
WEIGHTS = np.arange(3000) // 7
named = ModuleType("named")
named.SIZE, named.KIND = np.float32(0.5), np.float64

@dataclass(frozen=True)
class Part(Block):
    numbers: Any = array(np.int64, 1, lambda counts, lanes: (lanes,))

def scaled(x):
    """A number of times."""
    return FACTOR * x

@unit
def other(x: int) -> int:
    """Another one."""
    return x - 1

@unit
def whole(part: Part, x: int) -> float:
    """The whole."""
    return scaled(x) + other(part.numbers[0]) + WEIGHTS[x] + named.KIND(named.SIZE)
'''
FOUND_ELSEWHERE = [  # what is changed, and how, where the machine code of `whole` is another
    ("FACTOR * x", "x * FACTOR"),
    ("FACTOR = 3", "FACTOR = 4"),
    ("FACTOR = 3", "FACTOR = 3.0"),
    ("// 7", "// 7 + (np.arange(3000) == 1500)"),
    ("np.float32(0.5)", "np.float32(0.25)"),
    ("np.float32(0.5)", "np.float64(0.5)"),
    ("np.float64\n", "np.float32\n"),
    ("array(np.int64", "array(np.int32"),
    ("    numbers", "    first: Any = array(bool, 2, None)\n    numbers"),
    ("def other(x: int)", "def other(x: float)"),
    ("other(part.numbers[0])", "scaled(part.numbers[0])"),
]
LEFT = [('"""The whole."""', '"""All."""'), ("A number", "Some"), ("\n\n", "\n# why\n\n\n"), ("x - 1", "x - 2")]


@pytest.mark.parametrize(("was", "now", "is_left"), [(*c, False) for c in FOUND_ELSEWHERE] + [(*c, True) for c in LEFT])
def test_only_what_machine_code_depends_on_gives_it_another_name(
    write: Write, was: str, now: str, is_left: bool
) -> None:
    assert was in LANES
    before = dependencies.fingerprint(write(LANES).whole)
    after = dependencies.fingerprint(write(LANES.replace(was, now), file="elsewhere.py").whole)
    assert (before == after) == is_left


def test_another_compiler_gives_it_another_name(write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dependencies, "_compiler", dependencies._compiler.__wrapped__)

    def name() -> str:
        return dependencies.fingerprint(write(LANES).whole)

    before = name()
    for source in dependencies.COMPILER:
        copy(cache.SIM_FOLDER / f"{source}.py", tmp_path)
    monkeypatch.setattr(dependencies, "__file__", tmp_path / "dependencies.py")
    found = [before, name()]
    for source in dependencies.COMPILER:
        with (tmp_path / f"{source}.py").open("a") as file:
            file.write("#")
        found.append(name())
    monkeypatch.setattr(dependencies, "version", lambda package: "0.63")
    found.append(name())
    assert found[0] == found[1]
    assert len({*found}) == len(found) - 1


NAMES = """
from mindrun.sim.dependencies import fingerprint
from mindrun.sim.warmup import every_unit
print(len(every_unit()), *sorted(map(fingerprint, every_unit())))
"""


def test_every_process_gives_it_the_same_name() -> None:
    found = [
        subprocess.check_output([sys.executable, "-c", NAMES], env=os.environ | {"PYTHONHASHSEED": seed}, text=True)
        for seed in ("1", "2")
    ]
    count, *names = found[0].split()
    assert found[0] == found[1]
    assert len({*names}) == len(names) == int(count)


def test_where_nothing_can_be_written_it_is_compiled_each_time(
    write: Write, made: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def mkdtemp(prefix: str) -> str:
        raise FileNotFoundError(prefix)

    monkeypatch.setenv("NUMBA_CACHE_DIR", os.devnull)
    monkeypatch.setattr("tempfile.mkdtemp", mkdtemp)
    nowhere = cache.folder.__wrapped__()
    monkeypatch.setattr(cache, "folder", lambda: nowhere)
    monkeypatch.setattr(compilation, "_begin", None)  # nobody could hand us anything
    compilation.compile_missing([write(TWICE).twice])
    assert starts(write)
    assert starts(write)
    assert made == ["written.twice"] * 2


@pytest.fixture
def shipped(place: Path, write: Write, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Machine code as in a wheel, for a kind of processors of which this one is."""
    monkeypatch.setattr(cache, "PROCESSORS", {"any": target().features})
    monkeypatch.setattr(cache, "target", lambda: Target(target().triple, "any", target().features))
    assert starts(write)
    monkeypatch.setattr(cache, "target", target)
    monkeypatch.setattr(cache, "fitting", lambda: ["any"])
    (kept,) = place.glob("*.code")
    cache.SHIPPED.mkdir()
    return kept.rename(cache.SHIPPED / kept.name)


def test_what_was_shipped_is_found_where_nothing_is_kept(
    place: Path, shipped: Path, write: Write, made: list[str]
) -> None:
    assert "-any-" in shipped.name
    assert starts(write)
    assert made == []
    assert [*place.glob("*.code")] == []
    assert not cache.is_native(write(TWICE).twice)


@pytest.mark.usefixtures("shipped")
def test_what_was_shipped_for_others_is_not_found(
    write: Write, made: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "fitting", lambda: ["other"])
    monkeypatch.setattr(cache, "PROCESSORS", {"other": ""})
    assert starts(write)
    assert made == ["written.twice"]


def test_which_kinds_a_processor_is_of(monkeypatch: pytest.MonkeyPatch) -> None:
    has = [name for name, is_there in cache.get_host_cpu_features().items() if is_there]
    lacks = [name for name, is_there in cache.get_host_cpu_features().items() if not is_there]
    kinds = {"all": f"+{has[0]},+{has[1]}", "one": f"+{has[0]},+{(lacks or ['x'])[0]}", "none": "+what-is-this"}
    monkeypatch.setattr(cache, "PROCESSORS", kinds)
    assert cache.fitting() == ["all"]
    for variable in ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"):
        with monkeypatch.context() as patch:
            patch.setenv(variable, "said")
            assert cache.fitting() == [], "who names a processor gets what is made for it"


@pytest.mark.parametrize("found", [True, False])
@pytest.mark.parametrize("native", [True, False])
@pytest.mark.parametrize("lasts", [True, False])
def test_native_code_is_made_behind_what_was_shipped(
    monkeypatch: pytest.MonkeyPatch, found: bool, native: bool, lasts: bool
) -> None:
    """And only then: where nothing can be kept it would be made again and again."""

    class Compiled:
        def units(self) -> list[None]:
            return [None]

        def compile(self, told: Callable[[], None]) -> None:
            pass

    begun: list[Any] = []
    known = SimpleNamespace(missing=lambda units: [] if found else [*units], is_native=lambda unit: native)
    monkeypatch.setattr(simulator, "cache", known)
    monkeypatch.setattr(cache, "lasts", lambda: lasts)
    monkeypatch.setattr(subprocess, "Popen", lambda words, env, **more: begun.append((words[-1], env, more)))
    simulator.ensure_compiled(Compiled(), lambda words: None)  # type: ignore[arg-type]
    assert len(begun) == (found and lasts and not native)
    for word, environment, more in begun:
        assert word == compilation.IN_BACKGROUND
        assert environment["NUMBA_CPU_NAME"] == target().processor, "else it would take what was shipped"
        assert more["start_new_session"], "it goes on when this process ends"


def test_a_warm_simulator_says_where_it_lies(mindc: Call) -> None:
    mindc("warmup")
    assert all(map(cache.is_native, every_unit()))
    said = mindc("warmup")
    assert (said.code, said.err) == (0, "")
    assert said.out == f"the simulator had been compiled for {target().processor}: {cache.folder()}\n"


DIGEST = """
from hashlib import sha256
import numpy as np
from mindlang.compiler.compile import load
from mindlang.lock.status import make_ready
from mindrun.sim.rollout import Rollout
found = load("examples/collect/collect.mind")
ready = make_ready(found.graph, found.sources)
digest = sha256()
for skill in ("GoToObject", "Avoid", "Collect"):
    rollout = Rollout(ready.policy, skill, skill, [skill], lanes=48)
    rollout.compile()
    genomes = np.random.default_rng(1).normal(0, 1, (24, rollout.genome_length)).astype(np.float32)
    scores = rollout.score(genomes, [1, 2])
    for part in (scores.total, scores.by_line, scores.ticks, scores.ended_by, scores.faults):
        digest.update(part.tobytes())
print(digest.hexdigest())
"""


@pytest.mark.slow
def test_vectors_of_any_width_have_the_same_bits(tmp_path: Path) -> None:
    """No processor's own instructions change a result: generic ones, those of wheels, and this one's."""
    kinds = {"native": {}, "generic": {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "+sse2"}}
    kinds |= {
        kind: {"NUMBA_CPU_NAME": kind, "NUMBA_CPU_FEATURES": features}
        for kind, features in cache.PROCESSORS.items()
        if kind in cache.fitting()
    }
    found = {}
    for kind, settings in kinds.items():
        environment = os.environ | settings | {"NUMBA_CACHE_DIR": str(tmp_path / kind)}
        ended = subprocess.run(
            [sys.executable, "-c", DIGEST], env=environment, cwd=ROOT, capture_output=True, text=True, check=True
        )
        found[kind] = ended.stdout
        processor = settings.get("NUMBA_CPU_NAME", target().processor)
        assert [*(tmp_path / kind).glob(f"*/sim.lanes.advance.advance-{processor}-*.code")]
    assert len(found["native"]) == 1 + 2 * hashlib.sha256().digest_size
    assert len(set(found.values())) == 1, found
    assert len(found) > 1
