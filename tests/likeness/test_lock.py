"""What a lock says of skills that share weights, and of those that began with the weights of others."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes

from mindlang.lock import Entry, Taught, lock_text, read_lock
from mindlang.lock.blobs import digest, record
from mindlang.lock.report import rows, survival
from mindlang.lock.signature import arrange
from mindlang.lock.status import Stale, Trained, Untaught, lessons_of, needed_skills, status, trained_weights
from mindlang.lock.world_changes import changes
from mindlang.lock.world_facts import Worlds
from tests.edits.taught import world_in
from tests.likeness.test_meaning import ALIKE, GO, SCHOOL, TOP, graph, named

TAUGHT = Taught("Roam", "Go", False, 10, 20, 3, 1.5)
LESSON = "  teaches Go on Roam for 10 generations\n"


def teach(path: Path, mind: Graph, name: str, seed: int = 1, **said: object) -> np.ndarray:
    """Random weights of a skill, recorded."""
    weights = np.random.default_rng(seed).uniform(-1, 1, genes(named(mind, name))).astype(np.float32)
    taught = replace(TAUGHT, master=name)
    record(path, mind, {name: weights}, taught, {}, world_in(mind, taught), **said)
    return weights


def test_it_stands_as_its_owner_does(tmp_path: Path) -> None:
    lock = tmp_path / "mind.lock"
    mind = graph(GO, ALIKE, TOP)
    assert isinstance(status(mind, {})["Back"], Untaught)
    teach(lock, mind, "Go")
    assert list(read_lock(lock)) == ["Go"]
    states = status(mind, read_lock(lock))
    assert states["Back"] == states["Go"]
    assert isinstance(states["Back"], Trained)
    wider = graph(GO + "  reads charge\n", ALIKE, TOP)
    found = status(wider, read_lock(lock))["Back"]
    assert isinstance(found, Stale)
    assert found.differences == ("reads charge is new",)


def test_what_is_missing_is_said_once() -> None:
    mind = graph(GO, ALIKE, TOP, "  influences Go at 1/2\n")
    assert trained_weights(mind, {}, ["Top", "Back", "Go"]) == ({}, ["Go has not been taught"])


def test_the_order_of_lines_changes_no_bit(tmp_path: Path) -> None:
    """The owner's weights stand in the order of its line, and so do the inputs and outputs of whoever is like it."""
    lock = tmp_path / "mind.lock"
    turned = "\nskill Go is mlp\n  reads near\n  reads eyes\n  drives right_wheel\n  drives left_wheel\n"
    straight = "\nskill Go is mlp\n  reads eyes\n  reads near\n  drives left_wheel\n  drives right_wheel\n"
    first = arrange(graph(straight, ALIKE, TOP), {})
    weights = teach(lock, first, "Go")
    second = arrange(graph(TOP, ALIKE, turned), read_lock(lock))
    engines = Engine(Policy(first, {"Go": weights})), Engine(Policy(second, {"Go": weights}))
    for readings in np.random.default_rng(0).random((20, first.width), np.float32):
        assert engines[0].tick(readings).tobytes() == engines[1].tick(readings).tobytes()


def test_a_row_says_whose_weights_they_are(tmp_path: Path) -> None:
    mind = graph(GO, ALIKE, TOP)
    teach(tmp_path / "mind.lock", mind, "Go")
    found = rows(mind, [tmp_path / "mind.mind"])
    assert {row.skill: row.like for row in found} == {"Top": "", "Back": "Go", "Go": ""}
    assert survival(found)[0] == "weights of Go fit"


def world(*texts: str):
    mind = graph(*texts)
    return Worlds(mind, None).of(mind.lessons[-1])


def test_the_world_of_a_lesson_knows_what_is_alike() -> None:
    above = "  teaches Go on Roam under Top for 10 generations\n"
    before = world(GO, ALIKE, TOP, SCHOOL, above)
    assert changes(before, world(TOP, GO, ALIKE, SCHOOL, above)) == []
    other = ALIKE.replace("reads far for near", "reads charge for near")
    told = changes(before, world(GO, other, TOP, SCHOOL, above))
    assert told == [
        "Back has changed: reads far for near, sends left_wheel at far / 2, "
        "now reads charge for near, sends left_wheel at charge / 2"
    ]
    other = "".join(line for line in ALIKE.splitlines(keepends=True) if "drives" not in line)
    assert changes(world(GO, other, TOP, SCHOOL, above), before) == [
        "Back has changed: sends right_wheel at far / 2, now sends left_wheel at far / 2, "
        "sends to left_wheel for right_wheel, sends to right_wheel for left_wheel"
    ]


def test_a_lesson_that_starts_from_another_skill_is_another() -> None:
    own = "\nskill Far is mlp\n  reads ears\n  reads near\n  drives left_wheel\n  drives right_wheel at near / 2\n"
    line = "  teaches Far on Roam for 10 generations"
    here, copied = (
        world(GO, own, ALIKE, TOP, SCHOOL, line + "\n"),
        world(GO, own, ALIKE, TOP, SCHOOL, line + " from Go\n"),
    )
    assert "starts_from" not in here.facts["lesson"]
    assert changes(here, copied) == ["taught from its weights, now from Go"]
    assert changes(copied, here) == ["taught from Go, now from its weights"]


def test_a_line_says_with_whose_weights_a_skill_began(tmp_path: Path) -> None:
    lock = tmp_path / "mind.lock"
    own = "\nskill Far is mlp\n  reads ears\n  reads near\n  drives left_wheel\n  drives right_wheel at near / 2\n"
    line = "  teaches Far on Roam for 10 generations"
    mind = graph(GO, own, ALIKE, TOP, SCHOOL, LESSON, f"{line}\n", f"{line} from Go\n")
    assert [needed_skills(mind, lesson) for lesson in mind.lessons] == [set(), set(), {"Go"}]
    began = digest(teach(lock, mind, "Go"))
    teach(lock, mind, "Far", 2, origins={"Far": ("Go", began)})
    entries = read_lock(lock)
    assert entries["Far"].origin == ("Go", began)
    assert f" | from Go:{began}" in lock_text(entries)
    state = status(mind, entries)["Far"]
    assert isinstance(state, Trained)
    assert not state.is_elsewhere
    now = digest(teach(lock, mind, "Go", 3))
    state = status(mind, read_lock(lock))["Far"]
    assert isinstance(state, Trained)
    assert state.changes == (f"began with another Go ({began[:4]}…, now {now[:4]}…)",)
    assert state.outdated == {mind.lessons[-1]}
    state = status(mind, {"Far": entries["Far"]})["Far"]
    assert isinstance(state, Trained)
    assert state.changes == (f"began with Go ({began[:4]}…), which has no weights now",)


def test_an_origin_taught_on_together_with_who_began_as_it_is_the_same(tmp_path: Path) -> None:
    lock = tmp_path / "mind.lock"
    own = GO.replace("Go", "Far")
    mind = graph(GO, own, ALIKE, f"{TOP}  influences Far at 1\n", SCHOOL, LESSON)
    began = digest(teach(lock, mind, "Go"))
    teach(lock, mind, "Far", 2, origins={"Far": ("Go", began)})
    teach(lock, mind, "Go", 3)
    entries = read_lock(lock)
    for master, is_elsewhere in ("Go", True), ("Top", False):
        last = replace(entries["Go"].taught, master=master)
        state = status(mind, {**entries, "Go": replace(entries["Go"], taught=last)})["Far"]
        assert isinstance(state, Trained)
        assert state.is_elsewhere == is_elsewhere


def test_a_lesson_whose_master_has_another_name_is_known_by_its_task() -> None:
    mind = graph(GO, ALIKE, TOP, SCHOOL, "  teaches Go on Roam under Top for 10 generations\n")
    [lesson] = mind.lessons
    taught = world(GO, ALIKE, TOP, SCHOOL, "  teaches Go on Roam under Top for 10 generations\n")
    entry = Entry("Go", "", "", TAUGHT, (), (taught,))
    renamed = replace(
        mind,
        master="Boss",
        skills=tuple(replace(each, name="Boss") if each.name == "Top" else each for each in mind.skills),
    )
    assert lessons_of(renamed, taught, entry, [replace(lesson, master="Boss")], None)
    assert not lessons_of(renamed, taught, entry, [replace(lesson, master="Boss", task="Other")], None)
