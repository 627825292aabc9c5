"""What an environment draws is a picture, red first, or it is said that it draws none."""

from typing import Any

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from mindrun.sim.outside.making import BrokenEnvironmentError
from mindrun.sim.outside.seen import WITHOUT_PICTURES, SeenEpisode

from tests.outside import minds, worlds


def drawn(picture: Any, monkeypatch: pytest.MonkeyPatch) -> Any:
    """What is seen before the first tick of an environment that draws this."""
    graph = minds.graph_of(minds.text())
    monkeypatch.setattr(worlds.Line, "render", lambda environment: picture)
    seen = SeenEpisode(graph, worlds.name(worlds.Line), None, 7, lambda first, last: np.zeros((0, 1), np.float32))
    return seen.image(0)


@pytest.mark.parametrize("shape", [(4, 6, 3), (1, 6, 3), (4, 1, 3), (1, 1, 3)])
def test_of_any_size(shape: tuple[int, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    picture = np.arange(np.prod(shape), dtype=np.uint8).reshape(shape)
    assert np.array_equal(drawn(picture, monkeypatch), picture)


NO_PICTURES = {
    "nothing": None,
    "number": 3,
    "text": "text",
    "flat": np.zeros((6, 3), np.uint8),
    "grey": np.zeros((4, 6, 1), np.uint8),
    "transparent": np.zeros((4, 6, 4), np.uint8),
    "several": np.zeros((1, 4, 6, 3), np.uint8),
    "without height": np.zeros((0, 6, 3), np.uint8),
    "without width": np.zeros((4, 0, 3), np.uint8),
    "fractions": np.zeros((4, 6, 3)),
    "signed": np.zeros((4, 6, 3), np.int8),
}


@pytest.mark.parametrize("picture", NO_PICTURES.values(), ids=NO_PICTURES)
def test_what_is_none_is_told(picture: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(BrokenEnvironmentError, match="tests/Line-v0 draws no pictures") as found:
        drawn(picture, monkeypatch)
    assert found.value.hint == WITHOUT_PICTURES
