"""The rover's wiring fits its mind, as the page of the example says."""

from pathlib import Path

import pytest
from mindrun.graph.bundle import read_bundle

from tests.calling import Call
from tests.language.examples import ROOT

LIGHT = ROOT / "examples" / "light"


def test_it_is_built_with_its_wiring(mindc: Call, tmp_path: Path) -> None:
    said = mindc("build", LIGHT / "light.mind", "--robot", LIGHT / "robot.yaml", "-o", tmp_path / "light.bundle")
    assert said.code == 0, said.err
    wiring = read_bundle(tmp_path / "light.bundle").wiring
    assert wiring
    glow = next(wire for wire in wiring.sensors if wire.sensor == "glow")
    assert (glow.low, glow.high) == pytest.approx((0.06, 0.85))  # said in per cent of a voltage
