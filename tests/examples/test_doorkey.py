"""DoorKey without its memory: the same weights open no door."""

import pytest

from mindlang import load
from mindlang.run.setup import NO_GENOME, layouts
from tests.language.examples import ROOT

FORGETFUL = ROOT / "examples" / "doorkey" / "forgetful.mind"


@pytest.mark.parametrize(("master", "reached"), [("Fetch", 20), ("Dazed", 0)])
def test_with_its_memory_it_reaches_every_goal_and_without_none(master: str, reached: int) -> None:
    pytest.importorskip("gymnasium")
    pytest.importorskip("minigrid")
    found = load(FORGETFUL).rollout("Fetch", master).score(NO_GENOME, layouts(1, 20)).total
    assert (found > 0).sum() == reached
