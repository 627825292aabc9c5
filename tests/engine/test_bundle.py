"""Bundles: what is written is what is read, and nothing else is."""

import json
import os
import subprocess
import sys
import zipfile
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.errors import BundleError
from mindrun.graph.bundle import Bundle, decode, decode_wiring, fingerprint, pack, read_bundle, unpack, write_bundle
from mindrun.graph.codec import encode
from mindrun.graph.describe import contents, describe
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.graph.wiring import Wiring
from mindrun.kinds.actuators.actuator import Wheel
from mindrun.robot.drivers.mock import MockSensor

from tests.draws import cases
from tests.engine.bundles import example, wired
from tests.engine.resealed import resealed
from tests.hierarchies import PROCEDURES, random_graph


@given(random_graph(fewest_hidden=1), st.integers(0, 2**32 - 1))
@settings(max_examples=cases(25))
def test_there_and_back(graph: Graph, seed: int) -> None:
    rng = np.random.default_rng(seed)
    weights = {
        s.name: rng.standard_normal(genes(s)).astype(np.float32) for s in graph.skills if genes(s) and not s.like
    }
    data = pack(Bundle(Policy(graph, weights), procedure_sources(graph, PROCEDURES)))
    back = unpack(data)
    assert back.graph == graph
    assert {name: w.tobytes() for name, w in back.policy.weights.items()} == {
        n: w.tobytes() for n, w in weights.items()
    }
    assert pack(back) == data
    engines = Engine(Policy(graph, weights), PROCEDURES), Engine(back.policy, back.procedures)
    for readings in rng.random((3, graph.width)):
        assert engines[0].tick(readings).tobytes() == engines[1].tick(readings).tobytes()


def test_a_bundle_runs_with_its_procedures(tmp_path: Path) -> None:
    bundle = example()
    digest = write_bundle(tmp_path / "a.bundle", Bundle(bundle.policy, bundle.procedures))
    assert digest == sha256((tmp_path / "a.bundle").read_bytes()).hexdigest()
    back = read_bundle(tmp_path / "a.bundle")
    assert Engine(back.policy, back.procedures).tick([0.25])[1] == 0.25
    with zipfile.ZipFile(tmp_path / "a.bundle") as archive:
        assert archive.testzip() is None
        assert archive.namelist()[0] == "manifest.json"


def test_reading_runs_no_procedure() -> None:
    unpack(pack(replace(example(), procedures={"parts.claw": "raise SystemExit('ran')"})))


def test_a_bundle_replaces_another_only_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.bundle"
    path.write_text("old")
    with pytest.raises(BundleError):
        write_bundle(path, Bundle(Policy(replace(example().graph, master="Nobody"), {}), {}))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_no_truncated_bundle_is_read() -> None:
    data = pack(example())
    for length in [*range(0, len(data), 7), len(data) - 1]:
        with pytest.raises(BundleError):
            unpack(data[:length])


def test_no_bit_can_flip() -> None:
    data = pack(example())
    for place in range(0, 8 * len(data), 37):
        flipped = bytearray(data)
        flipped[place // 8] ^= 1 << place % 8
        with pytest.raises(BundleError):
            unpack(bytes(flipped))


@given(st.data())
@settings(max_examples=cases(300), suppress_health_check=[HealthCheck.too_slow])
def test_a_bundle_forged_with_care_is_read_or_refused(data: st.DataObject) -> None:
    """The hash at the end made right again after a change: still no other exception."""
    body = bytearray(pack(example())[:-64])
    for _ in range(data.draw(st.integers(1, 4))):
        body[data.draw(st.integers(0, len(body) - 1))] = data.draw(st.integers(0, 255))
    with suppress(BundleError):
        unpack(bytes(body) + sha256(body).hexdigest().encode())


NONE, DAMAGED = "this is not a bundle", "this bundle is damaged: build or copy it again"


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", NONE),
        (b"not a bundle", NONE),
        (b"\xff" * 200, NONE),
        (b"PK", DAMAGED),
        (b"PK\x05\x06" + bytes(18), DAMAGED),
        (pack(example()) + b"\n", DAMAGED),
    ],
)
def test_other_files_are_refused(tmp_path: Path, data: bytes, why: str) -> None:
    path = tmp_path / "x.bundle"
    path.write_bytes(data)
    with pytest.raises(BundleError) as caught:
        read_bundle(path)
    assert str(caught.value) == f"{path}: {why}"


def test_what_is_larger_than_a_bundle_can_be_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BundleError, match=r"larger than a bundle can be \(64 MiB\)"):
        unpack(bytes((64 << 20) + 1))
    with pytest.raises(BundleError, match=NONE):
        unpack(bytes(64 << 20))
    path = tmp_path / "x.bundle"
    path.touch()
    os.truncate(path, (64 << 20) + 1)
    with pytest.raises(BundleError, match="it is larger than 64 MiB"):
        read_bundle(path)
    os.truncate(path, 64 << 20)
    with pytest.raises(BundleError, match=NONE):
        read_bundle(path)


def test_what_would_be_too_large_is_not_packed(monkeypatch: pytest.MonkeyPatch) -> None:
    data = pack(example())
    monkeypatch.setattr("mindrun.graph.bundle.MAX_BUNDLE_BYTES", len(data))
    assert pack(example()) == data
    monkeypatch.setattr("mindrun.graph.bundle.MAX_BUNDLE_BYTES", len(data) - 1)
    with pytest.raises(BundleError, match="cannot be larger than"):
        pack(example())


def test_the_same_mind_has_the_same_bytes() -> None:
    """Its files are text as anyone would write it, and in one order, whoever has put the mind together."""
    bundle = example()
    with zipfile.ZipFile(BytesIO(pack(bundle))) as archive:
        for name, said in (("graph.json", encode(bundle.graph)), ("manifest.json", None)):
            text = archive.read(name).decode()
            tree = said or json.loads(text)
            assert text == json.dumps(tree, ensure_ascii=False, sort_keys=True, separators=(",", ":"))
    two = {f"a.b{number}": "x = 1" for number in range(2)}
    assert pack(replace(bundle, procedures=two)) == pack(replace(bundle, procedures=dict(reversed(two.items()))))


def test_a_fresh_process_knows_the_drivers_of_a_bundle(tmp_path: Path) -> None:
    (tmp_path / "a.bundle").write_bytes(pack(wired()))
    program = "import sys, pathlib, mindrun.graph.bundle as bundle; bundle.read_bundle(pathlib.Path(sys.argv[1]))"
    subprocess.run([sys.executable, "-c", program, tmp_path / "a.bundle"], check=True)


def test_a_missing_file_or_a_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BundleError, match="No such file"):
        read_bundle(tmp_path / "x.bundle")
    with pytest.raises(BundleError, match="it is a folder"):
        read_bundle(tmp_path)


def test_what_cannot_be_read_is_not_built() -> None:
    bundle = example()
    wheel = replace(bundle.graph.actuators[0], kind=Wheel("left", neutral=7.0))
    with pytest.raises(BundleError, match="neutral cannot be 7"):
        decode(encode(replace(bundle.graph, actuators=(wheel,))))


def test_a_wiring_travels_with_its_mind(tmp_path: Path) -> None:
    bundle = wired()
    assert bundle.wiring
    write_bundle(tmp_path / "a.bundle", Bundle(bundle.policy, bundle.procedures, bundle.wiring))
    back = read_bundle(tmp_path / "a.bundle")
    assert back.wiring == bundle.wiring
    assert pack(back) == pack(bundle)
    with zipfile.ZipFile(tmp_path / "a.bundle") as archive:
        manifest = json.loads(archive.read("manifest.json"))
        assert manifest["wiring"] == sha256(archive.read("wiring.json")).hexdigest() == fingerprint(bundle.wiring)


def test_a_mind_without_a_robot_is_the_bundle_that_it_always_was() -> None:
    with zipfile.ZipFile(BytesIO(pack(example()))) as archive:
        manifest = json.loads(archive.read("manifest.json"))
        assert manifest["format"] == "mind bundle 5"
        assert "wiring" not in manifest
        assert "wiring.json" not in archive.namelist()


def test_a_wiring_is_described() -> None:
    bundle = wired()
    assert bundle.wiring
    lines = describe(bundle).splitlines()
    assert f"robot test, wiring {fingerprint(bundle.wiring)[:12]}" in lines
    assert "sensor r0 is wired to mock: 0 to 2, 20 Hz, the median of 3, hold when older than 0.25 s" in lines
    assert "actuator left_wheel is wired to mock: 0 to 1" in lines
    assert contents(bundle)["robot"]["sensors"][0]["driver"]["value"] == 0.25
    assert "robot" not in contents(example())


WRONG_WIRES = {
    "robot cannot be": lambda wiring: replace(wiring, robot="\x1b[2J"),
    "sensors": lambda wiring: replace(wiring, sensors=()),
    "actuators": lambda wiring: replace(wiring, actuators=wiring.actuators[::-1]),
    "readings": lambda wiring: with_sensor(wiring, driver=MockSensor(count=2)),
    "no range": lambda wiring: with_sensor(wiring, high=0.0),
    "median cannot be 99": lambda wiring: with_sensor(wiring, median=99),
    "on_fault cannot be 'panic'": lambda wiring: with_sensor(wiring, on_fault="panic"),
    "neutral": lambda wiring: replace(wiring, actuators=(replace(wiring.actuators[0], low=0.6), *wiring.actuators[1:])),
}


def with_sensor(wiring: Wiring, **changes: object) -> Wiring:
    return replace(wiring, sensors=(replace(wiring.sensors[0], **changes),))


@pytest.mark.parametrize("why", WRONG_WIRES)
def test_a_wiring_of_another_mind_is_refused(why: str) -> None:
    bundle = wired()
    with pytest.raises(BundleError, match=why):
        unpack(pack(replace(bundle, wiring=WRONG_WIRES[why](bundle.wiring))))


def test_a_driver_that_this_mindrun_does_not_have_is_named() -> None:
    tree = json.loads(json.dumps(encode(wired().wiring)))
    tree["sensors"][0]["driver"]["is"] = "sonar"
    with pytest.raises(BundleError, match=r"driver is 'sonar', which is no sensor driver of this mindrun"):
        decode_wiring(tree, wired().graph)


def test_a_newer_bundle_is_refused_in_words() -> None:
    with pytest.raises(BundleError, match=r"'mind bundle 7'.*install the mindrun of the mindc that built it"):
        unpack(resealed(pack(wired()), lambda members: None, {"format": "mind bundle 7"}))
