"""What becomes of trained weights when a source is edited: they follow, or it is said why not."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Edge, Gate, Graph, Program, Sensor
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.sensors.battery import Battery

from mindlang.compiler.compile import load
from mindlang.editing.apply import apply_edit, write
from mindlang.editing.edits import edit
from mindlang.editing.lock_update import update_locks
from mindlang.editing.project import EditError, MindChange, open_project
from mindlang.editing.summary import summarise
from mindlang.lock import lock_path, read_lock, write_lock
from mindlang.lock.blobs import FOLDER, blob
from mindlang.lock.signature import arrange
from mindlang.lock.status import NotLearning, Stale, Trained, Untaught, make_ready
from tests.draws import cases
from tests.edits.taught import MIND, statuses, teach, write_mind
from tests.hierarchies import PROCEDURES, random_graph
from tests.lock.test_trained import _whole_sensors as whole_sensors
from tests.lock.test_trained import teach as teach_graph

TICKS = 12


@pytest.fixture
def drive(tmp_path: Path) -> Path:
    path = write_mind(tmp_path)
    teach(path)
    return path


def made(path: Path, name: str, keep_weights: bool = False, **said: Any) -> list[str]:
    """Make an edit of a file; what is said of the weights."""
    project = open_project(load(path))
    edited = apply_edit(project, edit(name).function(project, **said), keep_weights)
    sentences = summarise(edited)
    write(edited)
    return sentences


def commands(path: Path, readings: np.ndarray) -> bytes:
    """What the master of a file commands for these readings."""
    compiled = load(path)
    assert compiled.graph
    ready = make_ready(compiled.graph, compiled.sources)
    assert ready.refusals == ()
    engine = Engine(ready.policy)
    return b"".join(engine.tick(row).tobytes() for row in readings)


def some_readings(path: Path) -> np.ndarray:
    graph = load(path).graph
    assert graph
    return np.random.default_rng(5).random((TICKS, graph.width), np.float32)


RENAMES = [
    ("skill", "Avoid", "Dodge"), ("skill", "Drive", "Top"), ("sensor", "eye", "view"), ("sensor", "charge", "full"),
    ("actuator", "left_wheel", "port"), ("memory", "mood", "temper"), ("task", "Roam", "Wander"),
    ("thing", "ball", "cup"), ("curriculum", "School", "Course"), ("body", "Robot", "Rover"),
]  # fmt: skip


@pytest.mark.parametrize(("noun", "old", "new"), RENAMES)
def test_a_rename_relabels(drive: Path, noun: str, old: str, new: str) -> None:
    before, lock = commands(drive, some_readings(drive)), read_lock(lock_path(drive))
    sentences = made(drive, "rename", old=old, new=new, noun=noun)
    renamed = [f"{new} has the weights of {old}"] if noun == "skill" else []
    assert sentences == [*renamed, "3 trained skills keep what was learnt"]
    assert commands(drive, some_readings(drive)) == before
    now = read_lock(lock_path(drive))
    assert {entry.weights for entry in now.values()} == {entry.weights for entry in lock.values()}
    text = lock_path(drive).read_text()
    named = noun in ("skill", "sensor", "actuator", "memory", "task", "thing") and old != "charge"
    assert (_stands(new, text), _stands(old, text)) == (named, False)
    assert _elsewhere(drive) == {}, "the worlds follow, too"


SPREAD = "  varies noise of eye 0 to 10%\n  varies noise of left_wheel 0 to 10%\n  fails right_wheel 1% per s\n"


@pytest.mark.parametrize("old", ["eye", "left_wheel", "right_wheel"])
def test_a_rename_relabels_what_differs_from_run_to_run(tmp_path: Path, old: str) -> None:
    path = write_mind(tmp_path, MIND.replace("  lasts 60", f"{SPREAD}  lasts 60"))
    teach(path)
    made(path, "rename", old=old, new="other")
    text = lock_path(path).read_text()
    assert (_stands("other", text), _stands(old, text)) == (True, False)
    assert _elsewhere(path) == {}


def test_a_rename_leaves_a_thing_that_is_called_like_a_memory(tmp_path: Path) -> None:
    path = write_mind(tmp_path, MIND.replace("of ball", "of mood").replace("contains ball", "contains mood"))
    teach(path)
    made(path, "rename", old="mood", new="temper", noun="memory")
    assert _elsewhere(path) == {}


def test_a_rename_relabels_what_a_mind_says_no_more(drive: Path) -> None:
    text = drive.read_text().replace("bearing of ball", "bearing of stone").replace("reach of ball", "reach of stone")
    drive.write_text(text.replace("  contains ball", "  contains stone is item\n  contains ball"))
    made(drive, "rename", old="ball", new="cup", noun="thing")
    lock = lock_path(drive).read_text()
    assert (_stands("cup", lock), _stands("ball", lock)) == (True, False)


def _elsewhere(path: Path) -> dict[str, tuple[str, ...]]:
    """The skills that were taught elsewhere, and why."""
    states = statuses(path).items()
    return {skill: state.changes for skill, state in states if isinstance(state, Trained) and state.changes}


def _stands(name: str, text: str) -> bool:
    return re.search(rf"\b{name}\b", text) is not None


def test_a_rename_relabels_the_lock_of_a_used_file_and_nothing_else(tmp_path: Path) -> None:
    parts, main = tmp_path / "parts.mind", tmp_path / "main.mind"
    parts.write_text(MIND)
    lessons = "curriculum More is genetic population 8\n  teaches Drive on Roam for 3 generations\n"
    main.write_text(f'use "parts.mind"\nmaster Drive\n{lessons}')
    teach(parts)
    teach(main, "Drive", seed=2)
    known = read_lock(lock_path(parts))
    origin = known["Avoid"].weights
    write_lock(lock_path(parts), {**known, "Go": replace(known["Go"], origin=("Avoid", origin))})
    readings = some_readings(main)
    before, old = commands(main, readings), read_lock(lock_path(parts))
    made(main, "rename", old="Avoid", new="Dodge", noun="skill")
    assert commands(main, readings) == before
    now = read_lock(lock_path(parts))
    taught = replace(old["Avoid"].taught, master="Dodge")
    assert now["Dodge"] == replace(old["Avoid"], skill="Dodge", taught=taught, worlds=now["Dodge"].worlds)
    assert [world.lesson.master for world in now["Dodge"].worlds] == ["Dodge"]
    assert now["Go"] == replace(old["Go"], origin=("Dodge", origin))
    assert _elsewhere(parts) == {}
    assert now["Drive"].subskills == (("Dodge", old["Avoid"].weights), ("Go", old["Go"].weights))
    assert read_lock(lock_path(main))["Drive"].signature.sends == ("Go", "Dodge")


def test_a_name_that_comes_back_takes_no_weights_of_before(drive: Path) -> None:
    """A line of a skill that was there once, whose name another skill now takes."""
    text = drive.read_text()
    drive.write_text(text.replace("skill Go ", "skill Went ").replace(" Go\n", " Went\n").replace(" Go on", " Went on"))
    teach(drive, "Went", seed=3)
    weights = read_lock(lock_path(drive))["Went"].weights
    made(drive, "rename", old="Went", new="Go", noun="skill")
    assert read_lock(lock_path(drive))["Go"].weights == weights


def test_encapsulating_keeps_all_weights(drive: Path) -> None:
    lock = read_lock(lock_path(drive))
    sentences = made(drive, "encapsulate", skill="Drive", new="Top", with_=("Go",), reads=("charge",))
    assert sentences == ["Top has not been taught", "3 trained skills keep what was learnt"]
    assert read_lock(lock_path(drive)) == lock
    assert isinstance(statuses(drive)["Top"], Untaught)


def test_parents_keep_their_weights_over_what_encapsulates_their_subskill(drive: Path) -> None:
    sentences = made(drive, "encapsulate", skill="Avoid", new="AvoidWell", reads=("charge",))
    states = statuses(drive)
    drives = states["Drive"]
    assert isinstance(drives, Trained)
    assert drives.entry.signature.sends == ("Go", "AvoidWell")
    assert sentences == [
        "Drive was taught elsewhere: taught without AvoidWell",
        "AvoidWell has not been taught",
        "3 trained skills keep what was learnt",
    ]


def test_what_takes_the_place_of_a_subskill_is_told_of_those_above(drive: Path) -> None:
    drives = "drives left_wheel\n  drives right_wheel\n  drives mood\n"
    drive.write_text(MIND.replace("task Roam", f"skill Dodge is mlp\n  reads charge\n  {drives}\ntask Roam"))
    teach(drive, "Dodge")
    old = read_lock(lock_path(drive))
    made(drive, "replace", skill="Avoid", new="Dodge")
    state = statuses(drive)["Drive"]
    assert isinstance(state, Trained)
    assert state.entry.weights == old["Drive"].weights
    assert state.changes == (
        f"taught with Avoid ({old['Avoid'].weights[:4]}…), which is not below it now",
        "taught without Dodge",
    )


def test_a_skill_may_take_the_place_of_one_that_it_influences(drive: Path) -> None:
    """What is above the old skill itself goes on influencing it, and keeps its weights."""
    careful = "skill Careful is mlp\n  reads eye\n  influences Avoid\n\n"
    drive.write_text(MIND.replace("task Roam", f"{careful}task Roam"))
    teach(drive, "Careful")
    made(drive, "replace", skill="Avoid", new="Careful")
    states = statuses(drive)
    assert {name: type(state) for name, state in states.items()} == {
        "Drive": Trained, "Careful": Trained, "Avoid": Trained, "Go": Trained, "Grab": NotLearning,
    }  # fmt: skip


def test_what_is_extracted_keeps_its_weights(drive: Path) -> None:
    sentences = made(drive, "extract", parent="Drive", new="Both", subskills=("Go", "Avoid"))
    assert sentences == [
        "Drive is stale: sends Both is new; sends Avoid is gone; sends Go is gone",
        "Both has not been taught",
        "2 trained skills keep what was learnt",
    ]


def test_what_is_removed_is_forgotten(drive: Path) -> None:
    made(drive, "disconnect", skill="Drive", target="Avoid")
    made(drive, "remove", what=("teaches", "Avoid", "on", "Roam", "for", "3", "generations"), from_="School")
    sentences = made(drive, "remove", what=("skill", "Avoid"))
    assert "Avoid is gone, its weights are forgotten" in sentences
    assert set(read_lock(lock_path(drive))) == {"Go", "Drive"}


STALE = [
    ("skill Go is mlp hidden 1", "skill Go is mlp hidden 1 width 9", "Go", "width was 4, now 9"),
    ("skill Go is mlp hidden 1", "skill Go is mlp hidden 3", "Go", "hidden was 1, now 3"),
    (
        "  reads ball_bearing\n  drives",
        "  reads charge\n  drives",
        "Go",
        "reads charge is new; reads ball_bearing is gone",
    ),
    ("at 0 30 330 deg", "at 0 30 deg", "Avoid", "eye had 3 readings, now 2"),
    ("  drives mood\n", "", "Avoid", "sends mood is gone"),
    ("  drives mood\n", "  drives mood\n  drives claw\n", "Avoid", "sends claw is new"),
    ("  influences Avoid\n", "  influences Avoid at 1\n", "Drive", "sends Avoid is gone"),
]


@pytest.mark.parametrize(("before", "after", "skill", "why"), STALE)
def test_each_change_makes_its_skill_stale_and_says_why(
    drive: Path, before: str, after: str, skill: str, why: str
) -> None:
    assert drive.read_text().count(before) == 1
    drive.write_text(drive.read_text().replace(before, after))
    assert statuses(drive)[skill] == Stale(tuple(why.split("; ")))
    others = {name for name, state in statuses(drive).items() if isinstance(state, Stale)} - {skill}
    assert others == ({"Drive"} if "deg" in before else set()), "only who reads it"


def test_nothing_else_makes_stale(drive: Path) -> None:
    comments = MIND.replace("\n\n", "\n\n# words\n").replace("  ", "\t ").replace("\n", "  # 1\r\n")
    paragraphs = MIND.split("\n\n")
    for text in (
        comments,
        "\n\n".join([paragraphs[0], *reversed(paragraphs[1:])]),
        MIND.replace("  reads ball_bearing\n  reads eye\n", "  reads eye\n  reads ball_bearing\n"),
        MIND.replace("  influences Go\n  influences Avoid\n", "  influences Avoid\n  influences Go\n"),
        MIND.replace("mlp hidden 2", "mlp"),
        MIND.replace("at 1", "at 20%").replace("size 2", "size 3"),
        MIND.replace("reads eye\n  drives left_wheel", "reads eye\n  stays frozen\n  drives left_wheel"),
    ):
        drive.write_bytes(text.encode())
        found = {name: type(state) for name, state in statuses(drive).items()}
        assert found == {"Drive": Trained, "Avoid": Trained, "Go": Trained, "Grab": NotLearning}


def test_a_retrained_subskill_only_marks_its_parents(drive: Path) -> None:
    old = read_lock(lock_path(drive))["Avoid"].weights
    teach(drive, "Avoid", seed=2)
    new = read_lock(lock_path(drive))["Avoid"].weights
    state = statuses(drive)["Drive"]
    assert isinstance(state, Trained)
    assert state.changes == (f"taught with another Avoid ({old[:4]}…, now {new[:4]}…)",)
    graph, sources = load(drive).graph, load(drive).sources
    assert graph
    assert make_ready(graph, sources).refusals == ()


@pytest.mark.parametrize("skill", ["Drive", "Go"])
def test_a_new_input_may_start_from_zeros(drive: Path, skill: str) -> None:
    readings = some_readings(drive)
    before, old = commands(drive, readings), read_lock(lock_path(drive))
    sentences = made(drive, "connect", keep_weights=True, skill=skill, target="charge")
    zeros = f"{skill} keeps its weights, with zeros for what is new"
    assert sentences == [zeros, "3 trained skills keep what was learnt"]
    assert commands(drive, readings) == before
    lock = read_lock(lock_path(drive))
    assert lock[skill].weights != old[skill].weights
    assert (drive.parent / FOLDER / f"{lock[skill].weights}.npy").exists()
    assert dict(lock["Drive"].subskills)["Go"] == lock["Go"].weights, "nobody is told of another Go"
    assert _elsewhere(drive) == {}


def test_a_new_subskill_starts_without_influence(drive: Path) -> None:
    spin = "skill Spin is rule\n  drives left_wheel at 1\n  drives right_wheel at 0\n\n"
    drive.write_text(MIND.replace("task Roam", f"{spin}task Roam"))
    readings = some_readings(drive)
    before = commands(drive, readings)
    made(drive, "integrate", keep_weights=True, skill="Drive", with_=("Spin",), reads=("charge", "mood"))
    assert commands(drive, readings) == before


@pytest.mark.parametrize("instead", ["  chooses one", "  influences Grab at 1"], ids=["chooses", "centred"])
def test_who_sends_no_0_where_its_weights_are_is_taught_again(drive: Path, instead: str) -> None:
    """An influence of 0 may be the greatest of all, and that of a centred network without a bias is 1/2."""
    spin = "skill Spin is rule\n  drives left_wheel at 1\n  drives right_wheel at 0\n\n"
    text = MIND.replace("  influences Grab at 1", instead).replace("task Roam", f"{spin}task Roam")
    centred = " centred 1" if "chooses" not in instead else ""
    drive.write_text(text.replace("skill Drive is mlp hidden 2", f"skill Drive is mlp hidden 2{centred}"))
    teach(drive)
    with pytest.raises(EditError, match=re.escape("Drive cannot keep its weights: sends Spin is new.")):
        made(drive, "integrate", keep_weights=True, skill="Drive", with_=("Spin",))


@pytest.mark.parametrize(
    ("name", "said", "why"),
    [
        ("connect", {"skill": "Drive", "target": "claw"}, "Drive cannot keep its weights: sends claw is new."),
        (
            "connect",
            {"skill": "Go", "target": "mood", "drives": True},
            "Go cannot keep its weights: sends mood is new.",
        ),
        ("disconnect", {"skill": "Drive", "target": "eye"}, "Drive cannot keep its weights: reads eye is gone."),
    ],
)
def test_what_cannot_start_from_zeros_is_refused(drive: Path, name: str, said: dict[str, Any], why: str) -> None:
    old = {path: path.read_bytes() for path in drive.parent.rglob("*") if path.is_file()}
    with pytest.raises(EditError) as refused:
        made(drive, name, keep_weights=True, **said)
    assert str(refused.value) == why
    assert refused.value.hint == "Leave --keep-weights out, and teach it again after the edit."
    assert {path: path.read_bytes() for path in drive.parent.rglob("*") if path.is_file()} == old


def test_weights_that_were_stale_before_are_not_widened(drive: Path) -> None:
    drive.write_text(drive.read_text().replace("skill Go is mlp hidden 1", "skill Go is mlp hidden 2"))
    sentences = made(drive, "connect", keep_weights=True, skill="Go", target="charge")
    assert sentences[0] == "Go is stale already, and more so: reads charge is new"


@given(random_graph(alike=False), st.data())
@settings(max_examples=cases(60), suppress_health_check=[HealthCheck.too_slow])
def test_widened_skills_do_the_same_to_the_bit(
    tmp_path_factory: pytest.TempPathFactory, graph: Graph, data: st.DataObject
) -> None:
    """Any skill of any hierarchy reads more and influences more, whatever is read, NaN too."""
    path = tmp_path_factory.mktemp("wide") / "a.lock"
    graph = arrange(whole_sensors(graph), {})
    weights = teach_graph(path, graph, seed=data.draw(st.integers(0, 99)))
    lock = read_lock(path)
    graph = arrange(graph, lock)
    wide = _wider(graph, data.draw)
    followed = update_locks({path: lock}, graph, wide, MindChange(()), keep_weights=True)
    after = arrange(wide, followed.locks[path])
    new = {
        name: followed.weights.get(blob(path.parent, entry.weights), weights[name])
        for name, entry in followed.locks[path].items()
    }
    engines = Engine(Policy(graph, weights), PROCEDURES), Engine(Policy(after, new), PROCEDURES)
    order = [[skill.name for skill in after.skills].index(skill.name) for skill in graph.skills]
    for readings in _readings(graph, data.draw):
        more = np.append(readings, np.float32(data.draw(st.sampled_from([0.0, 0.5, 1.0]))))
        place = sum(sensor.width for sensor in graph.sensors)  # a new sensor stands before the memories
        moved = np.concatenate([readings[:place], more[-1:], readings[place:]])
        assert engines[0].tick(readings).tobytes() == engines[1].tick(moved).tobytes()
        known = ~np.isnan(engines[0].influence)  # what was out of the master's reach may be in it now
        assert engines[0].influence[known].tobytes() == engines[1].influence[order][known].tobytes()


def _wider(graph: Graph, draw: Any) -> Graph:
    """The graph with one more sensor, which some skills read, and with more influences from parents to children."""
    place = sum(sensor.width for sensor in graph.sensors)
    fresh = Sensor("fresh", Battery(), place, 1)
    memories = tuple(replace(memory, start=memory.start + 1) for memory in graph.memories)

    def moved(index: int) -> int:
        return index + (index >= place)

    def elsewhere(program: Program) -> Program:
        return tuple((w, moved(int(v))) if w == "reading" else (w, v) for w, v in program)

    skills = []
    for number, skill in enumerate(graph.skills):
        inputs = tuple(map(moved, skill.inputs))
        edges = [
            replace(edge, value=elsewhere(edge.value), gate=edge.gate and _gate(edge.gate, elsewhere))
            for edge in skill.edges
        ]
        if genes(skill):
            inputs += (place,) * draw(st.booleans())
        if genes(skill) and not skill.chooses and skill.function.bias >= skill.function.centred:
            known = {edge.target for edge in edges if edge.to == "skill"}
            below = [n for n in range(number + 1, len(graph.skills)) if n not in known]
            for target in draw(st.lists(st.sampled_from(below), unique=True, max_size=2)) if below else []:
                outputs = sum(edge.output is not None for edge in edges)
                edges.append(Edge("skill", target, outputs))
        skills.append(replace(skill, inputs=inputs, edges=tuple(edges)))
    return replace(graph, sensors=(*graph.sensors, fresh), memories=memories, skills=tuple(skills))


def _gate(gate: Gate, other: Callable[[Program], Program]) -> Gate:
    return Gate(other(gate.when), None if gate.otherwise is None else other(gate.otherwise))


def _readings(graph: Graph, draw: Any) -> np.ndarray:
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    readings = rng.random((6, graph.width), np.float32)
    for _ in range(draw(st.integers(0, 4))):
        place = draw(st.tuples(st.integers(0, 5), st.integers(0, graph.width - 1)))
        readings[place] = draw(st.sampled_from([np.nan, np.inf, -np.inf, -0.0, 0.0, 3e38, 1e-42]))
    return readings
