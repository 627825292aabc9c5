"""Wirings fit their minds, as the pages of the examples say."""

from pathlib import Path

import pytest
from mindrun.graph.bundle import read_bundle

from tests.calling import Call
from tests.language.examples import ROOT


@pytest.mark.parametrize(
    ("name", "sensor", "ends"),
    [
        ("light", "glow", (0.06, 0.85)),  # said in per cent of a voltage
        ("ball", "gaze", (-0.1, 1.1)),  # a whole turn, of which the servo's potentiometer has half
    ],
)
def test_it_is_built_with_its_wiring(
    mindc: Call, tmp_path: Path, name: str, sensor: str, ends: tuple[float, float]
) -> None:
    folder, bundle = ROOT / "examples" / name, tmp_path / f"{name}.bundle"
    said = mindc("build", folder / f"{name}.mind", "--robot", folder / "robot.yaml", "-o", bundle)
    assert said.code == 0, said.err
    wiring = read_bundle(bundle).wiring
    assert wiring
    wire = next(wire for wire in wiring.sensors if wire.sensor == sensor)
    assert (wire.low, wire.high) == pytest.approx(ends)
