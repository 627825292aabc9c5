"""Which weights fit: found again in any order of lines, stale with the exact difference, refused if damaged."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Edge, Graph, Sensor, Task
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.scenes.scene import Plain
from mindrun.kinds.sensors.rays import RangeFinder

from mindlang.lock import LockError, Taught, read_lock
from mindlang.lock.blobs import FOLDER, digest, record
from mindlang.lock.signature import arrange
from mindlang.lock.status import NotLearning, Stale, Trained, Untaught, status, trained_weights
from tests.draws import cases
from tests.edits.taught import world_in
from tests.hierarchies import PROCEDURES, random_graph
from tests.minds import CLAW, WHEELS, always, mind, rule, skill

Weights = dict[str, np.ndarray]
TAUGHT = Taught("Task", "Top", False, 10, 20, 3, 1.5)


def example() -> Graph:
    """Top over Go and Turn; Go reads a sensor with three readings."""
    top = skill("Top", Mlp(1), (3,), ("skill", 1), ("skill", 2))
    go = skill("Go", Mlp(2), (0, 1, 2, 3), ("actuator", 0), ("actuator", 1))
    turn = rule("Turn", always("actuator", 0, 1.0))
    graph = mind(top, go, turn, readings=1, actuators=(*WHEELS, CLAW))
    eyes = Sensor("eyes", RangeFinder(at=(0.0, 1.0, 2.0)), 0, 3)
    task = Task("Task", Plain(), (), 60, (), (), (), (), ())
    return replace(graph, sensors=(eyes, replace(graph.sensors[0], name="battery", start=3)), tasks=(task,))


def with_skill(graph: Graph, place: int, **changes: object) -> Graph:
    """The graph with one skill changed."""
    skills = list(graph.skills)
    skills[place] = replace(skills[place], **changes)
    return replace(graph, skills=tuple(skills))


def teach(path: Path, graph: Graph, seed: int = 1) -> dict[str, np.ndarray]:
    """Random weights for every skill that learns, base skills first, recorded."""
    rng = np.random.default_rng(seed)
    weights: dict[str, np.ndarray] = {}
    for each in reversed(graph.skills):
        if genes(each) and not each.like:
            weights[each.name] = rng.standard_normal(genes(each)).astype(np.float32)
            _record(path, graph, {each.name: weights[each.name]}, others=weights)
    return weights


def _record(path: Path, graph: Graph, learnt: Weights, master: str = "Top", others: Weights | None = None) -> None:
    taught = replace(TAUGHT, master=master)
    record(path, graph, learnt, taught, others or {}, world_in(graph, taught))


def names(graph: Graph) -> list[str]:
    """The names of the skills."""
    return [each.name for each in graph.skills]


def test_what_was_recorded_is_found(tmp_path: Path) -> None:
    graph, path = example(), tmp_path / "a.lock"
    weights = teach(path, graph)
    lock = read_lock(path)
    found, refusals = trained_weights(graph, lock, names(graph))
    assert refusals == []
    assert {name: w.tobytes() for name, w in found.items()} == {name: w.tobytes() for name, w in weights.items()}
    assert lock["Top"].subskills == (("Go", digest(weights["Go"])),)
    line = "Go is mlp hidden 2 width 6 | reads eyes:3 battery | sends left_wheel right_wheel | weights "
    assert str(lock["Go"]).startswith(line)
    states = status(graph, lock)
    assert isinstance(states["Top"], Trained)
    assert isinstance(states["Turn"], NotLearning)


def test_untaught(tmp_path: Path) -> None:
    assert status(example(), {})["Go"] == Untaught()
    assert trained_weights(example(), {}, ["Go"]) == ({}, ["Go has not been taught"])


def _edges(*targets: tuple[str, int]) -> tuple[Edge, ...]:
    return tuple(Edge(to, target, i) for i, (to, target) in enumerate(targets))


@pytest.mark.parametrize(
    ("changes", "differences"),
    [
        ({"function": Mlp(3)}, ("hidden was 2, now 3",)),
        ({"function": Mlp(2, width=9)}, ("width was 6, now 9",)),
        ({"inputs": (0, 1, 2)}, ("reads battery is gone",)),
        ({"inputs": (3,)}, ("reads eyes is gone",)),
        ({"edges": _edges(("actuator", 0), ("actuator", 2))}, ("sends claw is new", "sends right_wheel is gone")),
        ({"function": Mlp(3), "inputs": (3,)}, ("reads eyes is gone", "hidden was 2, now 3")),
    ],
)
def test_stale(tmp_path: Path, changes: dict[str, object], differences: tuple[str, ...]) -> None:
    path = tmp_path / "a.lock"
    teach(path, example())
    changed = with_skill(example(), 1, **changes)
    lock = read_lock(path)
    assert status(changed, lock)["Go"] == Stale(differences)
    assert trained_weights(changed, lock, ["Go"])[1] == [f"the weights of Go are stale: {'; '.join(differences)}"]


def test_stale_where_a_sensor_has_other_readings(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    teach(path, example())
    graph = with_skill(with_skill(example(), 1, inputs=(0, 1, 2)), 0, inputs=(2,))
    eyes, battery = graph.sensors
    changed = replace(graph, sensors=(replace(eyes, width=2), replace(battery, start=2)))
    states = status(changed, read_lock(path))
    assert states["Go"] == Stale(("eyes had 3 readings, now 2",))
    assert isinstance(states["Top"], Trained)


def test_edges_with_at_take_no_weights(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    teach(path, example())
    go = example().skills[1]
    changed = with_skill(example(), 1, edges=(always("actuator", 2, 1.0), *go.edges))
    assert isinstance(status(changed, read_lock(path))["Go"], Trained)


@pytest.mark.parametrize("master", ["Go", "Turn"])
def test_a_retrained_subskill_only_marks_its_parents(tmp_path: Path, master: str) -> None:
    """It was taught where none of them was."""
    graph, path = example(), tmp_path / "a.lock"
    old = teach(path, graph)["Go"]
    new = old + np.float32(1)
    _record(path, graph, {"Go": new}, master)
    state = status(graph, read_lock(path))["Top"]
    assert isinstance(state, Trained)
    assert state.changes == (f"taught with another Go ({digest(old)[:4]}…, now {digest(new)[:4]}…)",)


def test_a_subskill_that_was_taught_on_the_job_marks_no_parent_that_was_there(tmp_path: Path) -> None:
    graph, path = example(), tmp_path / "a.lock"
    old = teach(path, graph)["Go"]
    _record(path, graph, {"Go": old + np.float32(1)})
    state = status(graph, read_lock(path))["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ()


def test_record_keeps_what_it_does_not_replace(tmp_path: Path) -> None:
    graph, path = example(), tmp_path / "a.lock"
    old = teach(path, graph)
    other = replace(graph, skills=tuple(replace(each, name=f"{each.name}2") for each in graph.skills))
    teach(path, other, seed=2)
    assert set(read_lock(path)) == {"Go", "Go2", "Top", "Top2"}
    _record(path, graph, {"Go": old["Go"] * 2})
    blobs = {file.stem for file in (tmp_path / FOLDER).iterdir()}
    named = {entry.weights for entry in read_lock(path).values()}
    assert blobs == named | {digest(old["Go"])}, "the old weights of Go stay, until mindc gc"


def test_weights_that_another_lock_names_stay(tmp_path: Path) -> None:
    graph = example()
    old = teach(tmp_path / "a.lock", graph)["Go"]
    _record(tmp_path / "b.lock", graph, {"Go": old})
    _record(tmp_path / "b.lock", graph, {"Go": old * 2})
    assert trained_weights(graph, read_lock(tmp_path / "a.lock"), ["Go"])[0]["Go"].tobytes() == old.tobytes()


def test_weights_that_cannot_be_written_are_told_by_name(tmp_path: Path) -> None:
    weights = {skill.name: np.ones(genes(skill), np.float32) for skill in example().skills if genes(skill)}
    (tmp_path / FOLDER).write_text("in the way")
    learnt = {name: weights[name] for name in ("Go", "Top")}
    with pytest.raises(LockError, match="the weights of Go and Top cannot be written: "):
        _record(tmp_path / "a.lock", example(), learnt)
    assert not (tmp_path / "a.lock").exists()


def test_a_damaged_lock_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    path.write_text("damaged")
    with pytest.raises(LockError):
        _record(path, example(), {"Go": np.ones(genes(example().skills[1]), np.float32)})
    assert path.read_text() == "damaged"


@pytest.mark.parametrize("damage", ["flip", "cut", "gone", "link"])
def test_damaged_weights_are_refused(tmp_path: Path, damage: str) -> None:
    graph, path = example(), tmp_path / "in" / "a.lock"
    path.parent.mkdir()
    teach(path, graph)
    lock = read_lock(path)
    blob = path.parent / FOLDER / f"{lock['Go'].weights}.npy"
    data = blob.read_bytes()
    blob.unlink()
    match damage:
        case "flip":
            blob.write_bytes(data[:200] + bytes([data[200] ^ 1]) + data[201:])
        case "cut":
            blob.write_bytes(data[:-1])
        case "link":
            (tmp_path / "outside").write_bytes(data)
            blob.symlink_to(tmp_path / "outside")
    remedy = "get it back, or train Go --from-scratch"
    message = {"gone": f"cannot be read: .*; {remedy}", "link": "leads out of"}.get(damage, f"is damaged: {remedy}")
    with pytest.raises(LockError, match=message):
        trained_weights(graph, lock, ["Go"])


@given(random_graph(fewest_hidden=1, alike=False), st.data())
@settings(max_examples=cases(60), suppress_health_check=[HealthCheck.too_slow])
def test_reordering_the_source_changes_no_bit(
    tmp_path_factory: pytest.TempPathFactory, graph: Graph, data: st.DataObject
) -> None:
    """Whole sensors read in another order, edges sent in another order, skills declared in another order."""
    path = tmp_path_factory.mktemp("lock") / "a.lock"
    graph = arrange(_whole_sensors(graph), {})
    weights = teach(path, graph)
    lock = read_lock(path)
    shuffled = arrange(_shuffled(graph, data.draw), lock)
    assert names(shuffled) == names(graph)
    found, refusals = trained_weights(shuffled, lock, names(shuffled))
    assert refusals == []
    first, second = Engine(Policy(graph, weights), PROCEDURES), Engine(Policy(shuffled, found), PROCEDURES)
    for readings in np.random.default_rng(0).random((3, graph.width), np.float32):
        assert first.tick(readings).tobytes() == second.tick(readings).tobytes()
        assert first.influence.tobytes() == second.influence.tobytes()


def _whole_sensors(graph: Graph) -> Graph:
    """The graph with skills that read whole sensors, as the language has it, and at least one.

    None chooses among values with `at`: of equals the first in the text is chosen, so there the order means something.
    """
    spans = _spans(graph)
    skills = []
    for each in graph.skills:
        inputs = [i for span in spans if set(span) & set(each.inputs) for i in span]
        chooses = each.chooses and all(edge.output is not None for edge in each.edges if edge.to == "skill")
        skills.append(replace(each, inputs=tuple(inputs or spans[0]), chooses=chooses))
    return replace(graph, skills=tuple(skills))


def _spans(graph: Graph) -> list[tuple[int, ...]]:
    """The readings of each sensor and of each memory that skills can name."""
    wide = [(sensor.start, sensor.width) for sensor in graph.sensors]
    wide += [(memory.start, memory.kind.width) for memory in graph.memories]
    return [tuple(range(start, start + width)) for start, width in wide]


def _shuffled(graph: Graph, draw) -> Graph:
    spans = _spans(graph)
    order = _another_order(graph, draw)
    place = {old: new for new, old in enumerate(order)}
    skills = []
    for old in order:
        each = graph.skills[old]
        read = [span for span in spans if set(span) <= set(each.inputs)]
        by_name = not isinstance(each.function, Procedure)  # whose readings and outputs stand in the order of its lines
        inputs = tuple(i for span in draw(st.permutations(read)) for i in span) if by_name else each.inputs
        edges, output = [], 0
        for edge in draw(st.permutations(each.edges)) if by_name else each.edges:
            target = place[edge.target] if edge.to == "skill" else edge.target
            edges.append(replace(edge, target=target, output=None if edge.output is None else output))
            output += edge.output is not None
        skills.append(replace(each, inputs=inputs, edges=tuple(edges)))
    return replace(graph, skills=tuple(skills))


def _another_order(graph: Graph, draw) -> list[int]:
    """Any order of the skills in which parents come first."""
    left = list(range(len(graph.skills)))
    order: list[int] = []
    while left:
        children = {e.target for i in left for e in graph.skills[i].edges if e.to == "skill"}
        order.append(draw(st.sampled_from([i for i in left if i not in children])))
        left.remove(order[-1])
    return order
