"""Lessons that begin with a copy of another skill's weights: brought into the order of the skill that is taught."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.kinds.functions.function import Function
from mindrun.train import RunError

from mindlang.compiler.resolve.curricula import counterparts
from mindlang.lock import read_lock
from mindlang.lock.signature import arrange
from mindlang.training.lesson_choice import TrainOptions, chosen_lessons
from mindlang.training.subject import origin_weights
from tests.draws import cases
from tests.hierarchies import networks
from tests.likeness.test_lock import teach
from tests.likeness.test_meaning import ALIKE, GO, SCHOOL, TOP, compiled, graph, named

FAR = "\nskill Far is mlp\n  reads far\n  reads eyes\n  drives right_wheel\n  drives left_wheel at far / 2\n"
FILE = Path("far.mind")
LESSONS = "  teaches Go on Roam for 10 generations\n  teaches Far on Roam for 10 generations from Go\n"


def test_what_stands_for_what() -> None:
    assert counterparts(("a", "b"), ("b", "a"), {}, {}) == {"a": "a", "b": "b"}
    assert counterparts(("a", "c:3"), ("c:3", "b"), {}, {}) == {"a": "b", "c:3": "c:3"}
    assert counterparts(("a", "c:3"), ("d:3", "b"), {}, {}) == {"a": "b", "c:3": "d:3"}
    assert counterparts(("a", "c"), ("d", "b"), {}, {}) is None
    assert counterparts(("a", "c:3"), ("a", "c:4"), {}, {}) is None
    assert counterparts(("a",), ("a", "b"), {}, {}) is None
    assert counterparts(("a", "d", "e"), ("b", "c"), {}, {}) is None


def test_of_each_kind_of_sensor_one_stands_for_the_only_one() -> None:
    kinds = {"a": "Bearing", "b": "Contact", "eyes": "Range", "x": "Bearing", "y": "Inside", "z": "Bearing"}
    assert counterparts(("a", "b"), ("x", "y"), {}, kinds) == {"a": "x", "b": "y"}
    assert counterparts(("a", "b"), ("y", "x"), {}, kinds) == {"a": "x", "b": "y"}
    assert counterparts(("a", "b"), ("x", "z"), {}, kinds) is None
    assert counterparts(("a", "z"), ("x", "z"), {}, kinds) == {"a": "x", "z": "z"}
    assert counterparts(("a", "z"), ("x",), {}, kinds) is None
    assert counterparts(("a:2",), ("x",), {}, kinds) is None
    assert counterparts(("a", "memo"), ("x", "note"), {}, kinds) == {"a": "x", "memo": "note"}


def test_what_is_new_stands_for_nothing() -> None:
    assert counterparts(("b", "a"), ("a",), {}, {}) == {"a": "a"}
    assert counterparts(("a", "c:3", "d:3"), ("a",), {}, {}) == {"a": "a"}
    assert counterparts(("a", "c:3"), ("b",), {}, {}) == {"a": "b"}
    assert counterparts(("a", "b"), ("c",), {}, {}) is None


def test_a_skill_stands_for_the_one_that_it_began_as() -> None:
    heirs = {"New": "Old", "Other": "Older"}
    assert counterparts(("New", "Other"), ("Older", "Old"), heirs, {}) == {"New": "Old", "Other": "Older"}
    assert counterparts(("New", "Some"), ("Old", "Older"), heirs, {}) == {"New": "Old", "Some": "Older"}
    assert counterparts(("New", "Old"), ("Old",), heirs, {}) == {"Old": "Old"}
    assert counterparts(("New", "Newer"), ("Old",), heirs | {"Newer": "Old"}, {}) is None


@given(
    networks(0),
    st.permutations(range(4)),
    st.permutations(range(3)),
    st.integers(0, 2**32 - 1),
)
@settings(max_examples=cases(60))
def test_reordered_weights_do_the_same(function: Function, inputs: list[int], outputs: list[int], seed: int) -> None:
    """But for rounding: the sums are taken in another order."""
    rng = np.random.default_rng(seed)
    weights = rng.uniform(-2, 2, function.genome_length(4, 3)).astype(np.float32)
    moved = function.reordered(weights, inputs, outputs)
    one, other = function.ready(4, 3, weights, {}), function.ready(4, 3, moved, {})
    for values in rng.random((3, 4), np.float32):
        assert np.allclose(one(values)[outputs], other(values[inputs]), rtol=1e-4, atol=1e-4)


def test_weights_are_copied_into_the_order_of_the_learner(tmp_path: Path) -> None:
    lock = tmp_path / "mind.lock"
    other = FAR.replace("drives right_wheel\n  drives left_wheel at far / 2", "drives left_wheel\n  drives right_wheel")
    own = "\nskill Go is mlp\n  reads eyes\n  reads near\n  drives left_wheel\n  drives right_wheel\n"
    mind = arrange(graph(own, other, ALIKE, TOP, SCHOOL, LESSONS), {})
    weights = teach(lock, mind, "Go")
    copy = origin_weights(mind, read_lock(lock), mind.lessons[1], FILE)
    assert list(copy) == ["Far"]
    go, far = (named(mind, name) for name in ("Go", "Far"))
    one, two = go.function.ready(3, 2, weights, {}), far.function.ready(3, 2, copy["Far"], {})
    eyes, near = np.float32([0.2, 0.9]), np.float32([0.4])
    assert np.allclose(one(np.concatenate([eyes, near])), two(np.concatenate([near, eyes])), atol=1e-6)


@given(
    st.sampled_from(
        [
            "mlp hidden 0",
            "mlp hidden 1",
            "mlp hidden 2",
            "mlp hidden 3 width 6",
            "elman",
            "elman width 5",
            "gru",
            "gru width 5",
            "mlp hidden 2 bias 1 centred 1",
            "gru bias 1 centred 1",
            "neat most 3 centred 1",
            "ctrnn",
            "ctrnn width 5",
        ]
    ),
    st.permutations(["near", "eyes", "ears", "charge"]),
    st.permutations(["influences Back", "influences Own", "drives left_wheel"]),
    st.integers(0, 2**32 - 1),
)
@settings(max_examples=cases(60))
def test_who_reads_and_influences_more_does_the_same_at_first(
    function: str, reads: list[str], sends: list[str], seed: int
) -> None:
    """The command is the same but for rounding, since sums are taken in another order, and what is new sends 0."""
    reading = "".join(f"  reads {name}\n" for name in reads)
    sending = "".join(f"  {line}\n" for line in sends)
    few = f"\nskill Few is {function}\n  reads eyes\n  reads near\n  drives left_wheel\n"
    many = f"\nskill Many is {function}\n{reading}{sending}"
    lesson = "  teaches Many on Roam for 10 generations from Few\n"
    mind = arrange(graph(GO, GO.replace("Go", "Own"), few, many, ALIKE, TOP, SCHOOL, lesson), {})
    known, learner = (named(mind, name) for name in ("Few", "Many"))
    rng = np.random.default_rng(seed)
    with TemporaryDirectory() as folder:
        weights = teach(Path(folder) / "mind.lock", mind, "Few", seed)
        copy = origin_weights(mind, read_lock(Path(folder) / "mind.lock"), mind.lessons[0], FILE)["Many"]
    one, other = known.function.ready(3, 1, weights, {}), learner.function.ready(6, 3, copy, {})
    sizes = {"near": 1, "eyes": 2, "ears": 2, "charge": 1}
    for _ in range(3):
        at = {name: rng.random(size, np.float32) for name, size in sizes.items()}
        sent = other(np.concatenate([at[name] for name in reads]))
        command = sends.index("drives left_wheel")
        assert np.allclose(sent[command], one(np.concatenate([at["eyes"], at["near"]])), atol=1e-5)
        assert np.delete(sent, command).tolist() == [0, 0]


def test_a_hierarchy_begins_as_another_one(tmp_path: Path) -> None:
    """Which of two subskills stands for which of two others, their lessons say."""
    lock, drives = tmp_path / "mind.lock", "  drives left_wheel\n  drives right_wheel\n"
    under = [
        f"\nskill {name} is mlp\n  reads {read}\n{drives}"
        for name, read in zip(["A", "B"], ["near", "far"], strict=True)
    ]
    above = "\nskill AB is mlp\n  reads eyes\n  influences A\n  influences B\n"
    new = [text.replace("skill ", "skill New").replace("reads", "reads ears\n  reads") for text in under]
    over = "\nskill NewAB is mlp\n  reads eyes\n  influences NewB\n  influences NewA\n"
    lessons = "".join(f"  teaches New{name} on Roam for 10 generations from {name}\n" for name in ("A", "B", "AB"))
    mind = arrange(graph(GO, ALIKE, TOP, *under, above, *new, over, SCHOOL, lessons), {})
    weights = teach(lock, mind, "AB")
    copy = origin_weights(mind, read_lock(lock), mind.lessons[2], FILE)["NewAB"]
    both = named(mind, "AB").function
    for eyes in np.random.default_rng(1).random((3, 2), np.float32):
        assert np.allclose(both.ready(2, 2, weights, {})(eyes)[::-1], both.ready(2, 2, copy, {})(eyes), atol=1e-6)


def test_a_lesson_waits_for_the_weights_that_it_begins_with(tmp_path: Path) -> None:
    mind = arrange(graph(GO, FAR, ALIKE, TOP, SCHOOL, LESSONS), {})
    with pytest.raises(RunError, match="Far cannot begin with the weights of Go: Go has not been taught") as refused:
        origin_weights(mind, {}, mind.lessons[1], FILE)
    assert refused.value.hint == "first: mindc train far.mind Go"
    assert origin_weights(mind, {}, mind.lessons[0], FILE) == {}


def test_a_lesson_waits_for_those_that_learn_with_it(tmp_path: Path) -> None:
    """Else all would begin from scratch, where the file says from what."""
    over = TOP.replace("skill Top is rule\n  influences Back at 1", "skill Over is mlp\n  reads far\n  influences Far")
    under = "\nskill Under is mlp\n  reads far\n  influences Go\n"
    lessons = "  teaches Over on Roam for 10 generations with subskills from Under\n" + LESSONS
    mind = arrange(graph(GO, FAR, ALIKE, TOP, over, under, SCHOOL, lessons), {})
    lock = tmp_path / "mind.lock"
    teach(lock, mind, "Under")
    with pytest.raises(RunError, match="with the weights of Under: Far has not been taught") as refused:
        origin_weights(mind, read_lock(lock), mind.lessons[0], FILE)
    assert refused.value.hint == "first: mindc train far.mind Far"
    teach(lock, mind, "Far")
    assert list(origin_weights(mind, read_lock(lock), mind.lessons[0], FILE)) == ["Over"]


def test_from_scratch_on_the_command_line_begins_with_nothing() -> None:
    mind = graph(GO, FAR, ALIKE, TOP, SCHOOL, LESSONS)
    lesson = TrainOptions(from_scratch=True).applied(mind.lessons[1])
    assert (lesson.from_scratch, lesson.starts_from) == (True, "")
    assert TrainOptions().applied(mind.lessons[1]) == mind.lessons[1]


def test_who_is_alike_is_not_taught_by_itself() -> None:
    mind = graph(GO, FAR, ALIKE, TOP, SCHOOL, LESSONS)
    with pytest.raises(RunError, match="Back is like Go: it has no weights of its own to be taught"):
        chosen_lessons(mind, None, ["Back"])


@pytest.mark.parametrize(
    ("far", "why"),
    [
        (FAR.replace("mlp", "elman"), "their functions differ"),
        (FAR.replace("mlp", "mlp hidden 1"), "their functions differ"),
        (FAR.replace("reads far", "reads far\n  reads charge"), "which stands for which cannot be told"),
        (FAR.replace("mlp", "mlp width 4").replace("reads far", "reads far\n  reads ears"), "their functions differ"),
        (FAR.replace("left_wheel at far / 2", "left_wheel"), "Far drives right_wheel, too, and a command of 0 is one"),
    ],
)
def test_weights_of_another_shape_are_refused(far: str, why: str) -> None:
    found = compiled(GO, far, ALIKE, TOP, SCHOOL, LESSONS)
    assert [each.code for each in found.diagnostics] == ["other-shape"]
    assert why in found.diagnostics[0].message
