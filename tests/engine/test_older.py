"""Bundles of older versions: what 0.1.0 had no word for is as it always was; what no release wrote is refused."""

import json
from typing import Any

import pytest
from mindrun.errors import BundleError
from mindrun.graph.bundle import decode, migrated, pack, unpack
from mindrun.graph.codec import encode
from mindrun.kinds.learners import Restarting

from tests.engine.bundles import example
from tests.engine.resealed import resealed


@pytest.mark.parametrize("form", [*(f"mind bundle {n}" for n in (1, 2, 3, 4, 7)), "", None, 3, ["mind bundle 5"]])
def test_other_formats_are_refused(form: Any) -> None:
    is_said = isinstance(form, str) and form
    said = f"this is a '{form}', .* build it again, or install the mindrun" if is_said else "this is not a bundle"
    with pytest.raises(BundleError, match=said):
        unpack(resealed(pack(example()), lambda members: None, {"format": form}))


@pytest.mark.parametrize("graph", [None, [], {}, {"lessons": 3}, {"lessons": [None]}, {"lessons": [{"learner": []}]}])
def test_what_is_no_graph_is_refused(graph: Any) -> None:
    def put(members: dict[str, bytes]) -> None:
        members["graph.json"] = json.dumps(graph).encode()

    with pytest.raises(BundleError, match="damaged"):
        unpack(resealed(pack(example()), put, {}))


def test_what_lessons_did_not_say_is_as_it_is_where_nothing_is_said() -> None:
    graph = example().graph
    data = encode(graph)
    (lesson,) = data["lessons"]
    del lesson["needs"], lesson["learner"]["founders"], lesson["learner"]["rungs"]
    assert decode(migrated(data)) == graph
    lesson["learner"]["founders"] = 12
    assert decode(migrated(data)).lessons[0].learner == Restarting(founders=12)


def test_a_learner_that_this_version_does_not_know_stays_as_it_is() -> None:
    data = encode(example().graph)
    data["lessons"][0]["learner"]["is"] = "gradient"
    assert migrated(data) == data
