"""Data of older bundles."""

from mindrun.encoding import decode, encode
from mindrun.learners import Restarting
from mindrun.older import with_whole_lessons

from .bundles import example


def test_what_lessons_did_not_say_is_as_it_is_where_nothing_is_said() -> None:
    graph = example().graph
    data = encode(graph)
    (lesson,) = data["lessons"]
    del lesson["number"], lesson["learner"]["founders"], lesson["learner"]["rungs"]
    assert decode(with_whole_lessons(data)) == graph
    lesson["learner"]["founders"] = 12
    assert decode(with_whole_lessons(data)).lessons[0].learner == Restarting(founders=12)


def test_a_learner_that_this_version_does_not_know_stays_as_it_is() -> None:
    data = encode(example().graph)
    data["lessons"][0]["learner"]["is"] = "gradient"
    assert with_whole_lessons(data) == data
