"""What a released version wrote is read by this one, and means the same to the bit: docs/versions.md promises it."""

from pathlib import Path

import pytest
from mindrun import VERSION
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import read_bundle
from mindrun.kinds.registry import kinds
from mindrun.robot.replay import replay_recording

import mindlang
from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.subject import subject_of_mind
from mindlang.compiler.source import Source
from mindlang.pictures.learning_log import load_curves
from mindlang.robot.wire import load_wiring
from tests.formats import FOLDER, MINDS, RELEASES
from tests.formats.write import RECORDED_TICKS, commands


@pytest.fixture(params=RELEASES)
def release(request: pytest.FixtureRequest) -> Path:
    """The folder of a released version."""
    return FOLDER / request.param


def minds(release: Path) -> list[str]:
    """The minds of a release whose commands are known."""
    return sorted(path.name.partition(".")[0] for path in release.glob("*.commands.jsonl"))


def readings(release: Path, mind: str) -> Path:
    """Where the readings of a mind are."""
    return release / f"{mind}.readings.jsonl"


def expected(release: Path, mind: str) -> str:
    """What it commanded for them."""
    return (release / f"{mind}.commands.jsonl").read_text(encoding="utf-8")


def test_this_version_has_its_folder() -> None:
    assert VERSION in RELEASES
    assert tuple(minds(FOLDER / VERSION)) == MINDS


def test_sources_locks_and_weights(release: Path) -> None:
    for name in minds(release):
        mind = mindlang.load(release / f"{name}.mind")
        assert not mind.diagnostics, name
        assert commands(mind.engine(), readings(release, name)) == expected(release, name), name
        assert not mind.notes(), name  # nor has the world changed in which its skills were taught


def test_bundles(release: Path) -> None:
    for name in minds(release):
        bundle = read_bundle(release / f"{name}.bundle")
        engine = Engine(bundle.policy, bundle.procedures)
        assert commands(engine, readings(release, name)) == expected(release, name), name


def test_wirings(release: Path) -> None:
    rover = mindlang.load(release / "rover.mind")
    assert rover.compiled.mind
    checked = load_wiring(release / "robot.yaml", rover.graph, rover.compiled.mind.unit_metres)
    assert checked.wiring == read_bundle(release / "rover.bundle").wiring


def test_recordings(release: Path) -> None:
    found = replay_recording(release / "rover.rec", release / "rover.bundle")
    assert (found.ticks, found.differs) == (RECORDED_TICKS, None)


def test_breakpoints_and_logs(release: Path) -> None:
    rover = mindlang.load(release / "rover.mind").compiled
    text = (release / "rover.break").read_text(encoding="utf-8")
    source = Source("rover.break", text, release)
    assert not breakpoints_of(source, subject_of_mind(rover)).diagnostics
    (curve,) = load_curves([release / "progress.csv"])
    assert curve


@pytest.mark.parametrize("noun", ["body", "actuator", "sensor", "memory", "scene", "content", "skill", "curriculum"])
def test_the_present_folder_has_every_kind(noun: str) -> None:
    text = "\n".join(path.read_text(encoding="utf-8") for path in (FOLDER / VERSION).glob("*.mind"))
    words = {*text.replace("\n", " ").split()}
    missing = {*kinds(noun)} - words
    assert not missing, f"add {missing} to a mind of tests/formats/{VERSION}, then python -m tests.formats.write"
