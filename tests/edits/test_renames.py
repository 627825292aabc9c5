"""A rename of anything in any mind: what was learnt, the world in which it was, and what the mind does stay."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.graph.weights import genes, owners, reachable

from mindlang.compiler.compile import load
from mindlang.compiler.families import is_of_family, letter_in
from mindlang.compiler.names import introductions
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits import edit
from mindlang.editing.lock_update import new_names, update_locks
from mindlang.editing.project import EditError, Project, open_project
from mindlang.editing.world_names import Renaming, now_called, renamed
from mindlang.lock import Entry, Lock, Taught, lock_sources, lock_text, read_locks
from mindlang.lock.signature import signature
from mindlang.lock.status import Status, Trained, status
from mindlang.lock.training_world import TrainingWorld
from mindlang.lock.world_facts import Worlds
from tests.edits.sources import MAIN, Texts, minds
from tests.language.examples import ROOT

OFTEN, SELDOM = 3000, 5  # cases of each test in the slow suite, and in the other
NEW = {
    False: ("fresh", "fresh", "p", "on", "when", "of", "ball", "eye", "left_wheel", "mood"),
    True: ("Fresh", "Fresh", "Go", "World"),
}
OTHERWISE = (
    *(("< 0.7", "< 0.6"), ("> 0.5", "> 0.4"), ("rewards 10 ", "rewards 11 "), ("1% per s", "2% per s")),
    *((f"is {kind} of ball", f"is {kind} of coin") for kind in ("bearing", "distance", "contact", "held", "light")),
)
SHIPPED = ("tour/tour", "rover/rover", "maze/maze")  # with every word, taught, with a map
LONG = ("collect/collect", "sort/sort", "soccer/soccer")


def taught(graph: Graph) -> Lock:
    """A lock as if every lesson of a mind had been taught, each skill with those that learn below it, from another."""
    known: dict[str, Entry] = {}
    for lesson in graph.lessons:
        skill = next(each for each in graph.skills if each.name == lesson.skill)
        below = {*owners(reachable(graph, skill.name))} - {skill.name}
        how = Taught(lesson.task, lesson.master, lesson.with_subskills, 3, 8, 1, 2.5, lesson.number, lesson.curriculum)
        world = Worlds(graph, None).of(lesson)
        other = next((each.skill for each in graph.lessons if each.skill != skill.name), None)
        known[skill.name] = Entry(
            skill.name,
            signature(graph, skill),
            "0" * 64,
            how,
            tuple(sorted((name, "0" * 64) for name in below)),
            (world,) if genes(skill) else (),
            origin=other and (other, "0" * 64),
        )
    return known


def names_of(project: Project) -> list[tuple[str, str]]:
    """Everything that has a name, with its noun; families by the name of their line."""
    named = ((mention.noun, mention.name) for mention in introductions(project.files))
    return list(dict.fromkeys((noun, name.span.text if is_of_family(name) else name.text) for noun, name in named))


def changes(states: Mapping[str, Status]) -> dict[str, tuple[type, int]]:
    """How every skill stands, and how much has changed since it was taught."""
    return {skill: (type(s), len(s.changes) if isinstance(s, Trained) else 0) for skill, s in states.items()}


def contents(lock: Lock) -> dict[str, Any]:
    """What a lock says; names in the lists of its worlds are sorted by those of before."""
    return {s: (replace(e, worlds=()), [unordered(world.facts) for world in e.worlds]) for s, e in lock.items()}


def unordered(value: Any) -> Any:
    match value:
        case dict():
            return {key: unordered(part) for key, part in value.items()}
        case list():
            return sorted(map(unordered, value), key=repr)
    return value


def holds(project: Project, lock: Lock, noun: str, old: str, new: str) -> tuple[Mapping[Path, str], Lock]:
    """A rename leaves how skills stand, and the mind but for its names; the texts and the lock after it."""
    change = edit("rename").function(project, old=old, new=new, noun=noun)
    edited = apply_edit(project, change, keep_weights=False)
    path = project.main.source.path
    followed = update_locks({path: lock}, project.graph, edited.graph, change, keep_weights=False).locks[path]
    names = new_names(change)
    before = {now_called(s, names, "skill"): how for s, how in changes(status(project.graph, lock)).items()}
    assert changes(status(edited.graph, followed)) == before, f"{noun} {old} is {new}"
    return edited.texts, followed


def all_renames_hold(texts: Texts, older: Texts, rng: Random, most: int) -> Iterator[str]:
    """Rename some of what has a name and back: the texts and the lock are the same to the byte then.

    Between the two the lock is as if it had been taught with the new names.
    """
    project, then = texts.project(), older.project()
    lock, kept = taught(then.graph), taught(renamed(then.graph, lambda text, *nouns: text))
    assert contents(kept) == contents(lock), "nothing is another where nothing is renamed"
    known = names_of(project)
    for noun, old in rng.sample(known, min(most, len(known))):
        new = rng.choice(NEW[old[0].isupper()]) + letter_in(old)
        try:
            after, followed = holds(project, lock, noun, old, new)
        except EditError:
            assert new not in ("fresh", "Fresh", "freshN", "FreshN"), "what nothing is called can be a name"
            yield "refused"
            continue
        yield noun
        named = edit("rename").function(then, old=old, new=new, noun=noun)
        assert contents(followed) == contents(taught(apply_edit(then, named, keep_weights=False).graph))
        there = texts.changed(dict(after))
        back, again = holds(there.project(), followed, noun, new, old)
        assert there.changed(dict(back)).files == texts.files
        assert lock_text(again) == lock_text(lock)


@pytest.mark.parametrize("cases", [SELDOM, pytest.param(OFTEN, marks=pytest.mark.slow)])
def test_a_rename_of_anything_in_any_mind(cases: int) -> None:
    """Taught in the mind as it is, or in one of which a few sentences were others."""

    @settings(max_examples=cases, deadline=None)
    @given(minds(), st.integers(0, 2**32 - 1))
    def every(texts: Texts, seed: int) -> None:
        rng = Random(seed)
        older = texts
        if rng.random() < 0.3:
            text = texts.files[MAIN]
            for now, then in OTHERWISE:
                text = text.replace(now, then)
            older = texts.changed({MAIN: text})
        for said in all_renames_hold(texts, older, rng, 4):
            event(said)

    every()


def test_what_no_mind_says_any_more_is_read_with_the_new_names() -> None:
    facts = {"sends": ["Search at 1 - eye", "o.Search at eye", "wheel at eye"]}
    world = TrainingWorld({"skill Go": facts, "lesson": {"task": "Seek", "master": "Go", "with_subskills": False}})
    names = {"skill": {"Search": "Find", "o.Search": "o.Find"}, "sensor": {"eye": "ear"}}
    now = Renaming(names, ()).relabelled(world).facts["skill Go"]
    assert now == {"sends": ["Find at 1 - ear", "o.Find at ear", "wheel at ear"]}


def test_a_thing_and_a_sensor_of_one_name_are_told_apart() -> None:
    held, read = {"is": "held", "of": "eye"}, {"is": "reading", "reading": 1, "of": "eye"}
    formula = {"is": "computed", "at": [["reading", "eye"], ["number", 1.0]]}
    lesson = {"task": "Seek", "master": "Go", "with_subskills": False}
    world = TrainingWorld({"sensor a": read, "sensor b": held, "sensor c": formula, "lesson": lesson})
    for noun, found in (("thing", (read, held | {"of": "ball"})), ("sensor", (read | {"of": "ball"}, held))):
        facts = Renaming({noun: {"eye": "ball"}}, ()).relabelled(world).facts
        assert (facts["sensor a"], facts["sensor b"]) == found
        assert facts["sensor c"]["at"][0] == ["reading", "eye" if noun == "thing" else "ball"]


def test_an_actuator_and_a_sensor_of_one_name_are_told_apart_where_no_mind_says_the_fact() -> None:
    graph = load(ROOT / "examples" / "collect" / "collect.mind").graph
    assert graph
    lesson = {"task": "Seek", "master": "Go", "with_subskills": False}
    facts = {"varying": ["fails left_wheel 0.5 per tick"], "skill Go": {"answers": ["left_wheel"]}, "lesson": lesson}
    assert Renaming({"sensor": {"left_wheel": "ear"}}, (graph,)).relabelled(TrainingWorld(facts)).facts == facts
    now = Renaming({"actuator": {"left_wheel": "wheel"}}, (graph,)).relabelled(TrainingWorld(facts)).facts
    assert now == facts | {"varying": ["fails wheel 0.5 per tick"], "skill Go": {"answers": ["wheel"]}}


@pytest.mark.parametrize("name", [*SHIPPED, *(pytest.param(name, marks=pytest.mark.slow) for name in LONG)])
def test_every_name_of_the_examples(name: str) -> None:
    """As they were taught, and where they were not, as if they had been."""
    compiled = load(ROOT / "examples" / f"{name}.mind")
    project = open_project(compiled)
    project = replace(project, neighbours=())
    lock = read_locks(lock_sources(compiled.sources)) or taught(project.graph)
    assert lock
    for noun, old in names_of(project):
        holds(project, lock, noun, old, f"{old}9")  # a map knows things by their first letter
