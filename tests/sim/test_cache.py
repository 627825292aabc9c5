"""Machine code between starts: whole and of these sources, versions and processor, or made anew."""

import hashlib
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import pytest
from mindrun.sim import cache, warmup
from mindrun.sim.compiling import compiled, entry
from numba.core.registry import cpu_target

import mindlang.cli._session as simulator
from tests.calling import Call
from tests.language.examples import ROOT


@compiled
def half(x):
    return x / 2


def twice_halved(x: float) -> float:
    return half(half(x))


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    monkeypatch.setattr(cache, "SHIPPED", tmp_path / "shipped")
    (tmp_path / "shipped").mkdir()
    return tmp_path


def loads(function: Callable[..., Any] = twice_halved, given: float = 10.0) -> bool:
    """Whether a function's machine code is found; it does what it should, either way."""
    dispatcher: Any = entry(function)
    assert dispatcher(given) == given / 4
    return sum(dispatcher.stats.cache_hits.values()) == 1


def test_what_was_compiled_is_found_at_the_next_start(place: Path) -> None:
    assert [loads(), loads()] == [False, True]
    (kept,) = place.glob("*.code")
    assert kept.name.startswith(f"test_cache.twice_halved-{cache.processor()}-")
    assert not loads(given=12), "of whole numbers it is another function"
    assert len([*place.glob("*.code")]) == 2


@pytest.mark.parametrize(
    "damage", [lambda data: data[:-1], lambda data: b"", lambda data: data[:50] + b"?" + data[51:]]
)
def test_what_is_damaged_is_made_anew(place: Path, damage: Callable[[bytes], bytes]) -> None:
    assert not loads()
    (kept,) = place.glob("*.code")
    kept.write_bytes(damage(kept.read_bytes()))
    assert [loads(), loads()] == [False, True]


def test_other_sources_have_other_machine_code(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert not loads()
    monkeypatch.setattr(cache, "stamp", lambda: "another")
    assert not loads()
    monkeypatch.undo()


def test_where_nothing_can_be_written_it_is_compiled_each_time(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "folder", lambda: place / "gone")
    assert [loads(), loads()] == [False, False]


@pytest.fixture
def shipped(place: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Machine code as in a wheel, for a kind of processors of which this one is."""
    monkeypatch.setattr(cache, "PROCESSORS", {"any": cpu_target.target_context.codegen().magic_tuple()[2]})
    monkeypatch.setattr(cache, "fitting", lambda: ["any"])
    monkeypatch.setattr(numba.config, "CPU_NAME", "any")
    assert not loads()
    monkeypatch.setattr(numba.config, "CPU_NAME", None)
    (kept,) = place.glob("*.code")
    return kept.rename(place / "shipped" / kept.name)


def test_what_was_shipped_is_found_where_nothing_is_kept(place: Path, shipped: Path) -> None:
    assert "-any-" in shipped.name
    assert loads()
    assert not [*place.glob("*.code")]


def test_what_was_shipped_for_others_is_not_found(place: Path, shipped: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "fitting", lambda: ["other"])
    monkeypatch.setattr(cache, "PROCESSORS", {"other": ""})
    assert not loads()


def test_which_kinds_a_processor_is_of(monkeypatch: pytest.MonkeyPatch) -> None:
    has = [name for name, is_there in cache.get_host_cpu_features().items() if is_there]
    lacks = [name for name, is_there in cache.get_host_cpu_features().items() if not is_there]
    kinds = {"all": f"+{has[0]},+{has[1]}", "one": f"+{has[0]},+{(lacks or ['x'])[0]}", "none": "+what-is-this"}
    monkeypatch.setattr(cache, "PROCESSORS", kinds)
    assert cache.fitting() == ["all"]
    monkeypatch.setattr(numba.config, "CPU_NAME", cache.processor())
    assert cache.fitting() == [], "who names a processor gets what is made for it"


@pytest.mark.parametrize(("is_there", "native"), [(True, True), (True, False), (False, False)])
def test_native_code_is_made_behind_what_was_shipped(
    monkeypatch: pytest.MonkeyPatch, is_there: bool, native: bool
) -> None:
    """And only then: where nothing can be kept it would be made again and again."""

    class Compiled:
        entries = ()

        def compile(self) -> None:
            pass

    started: list[str] = []
    monkeypatch.setattr(warmup, "is_there", lambda entries: is_there)
    monkeypatch.setattr(warmup, "is_native", lambda entries: native)
    monkeypatch.setattr(warmup, "start", lambda *words: started.extend(words))
    simulator.ensure_compiled(Compiled(), lambda words: None)  # type: ignore[arg-type]
    assert started == ([warmup.IN_BACKGROUND] if is_there and not native else [])


def test_a_warm_simulator_says_where_it_lies(mindc: Call) -> None:
    warmup.warm_up()
    said = mindc("warmup")
    assert (said.code, said.err) == (0, "")
    assert said.out == f"the simulator had been compiled for {cache.processor()}: {cache.folder()}\n"


DIGEST = """
from hashlib import sha256
import numpy as np
from mindlang.compiler.compile import load
from mindlang.lock.ready import make_ready
from mindrun.sim.rollout import Rollout
found = load("examples/collect/collect.mind")
ready = make_ready(found.graph, found.sources)
digest = sha256()
for skill in ("GoToObject", "Avoid", "Collect"):
    rollout = Rollout(ready.policy, skill, skill, [skill], lanes=48)
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
    assert len(found["native"]) == 1 + 2 * hashlib.sha256().digest_size
    assert len(set(found.values())) == 1, found
    assert len(found) > 1
