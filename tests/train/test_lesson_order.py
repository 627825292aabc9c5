"""What `status`, `lint` and `train` say of lessons: the same; and in which order these are taught."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.shapes import HEAD
from mindlang.compiler.compile import compile_source, load
from mindlang.compiler.source import Source
from mindlang.lock.status import Trained, needed_skills
from mindlang.training.lesson_choice import chosen_lessons
from mindlang.training.subject import open_subject
from tests.calling import Call
from tests.draws import cases
from tests.edits.taught import MIND, statuses, teach, write_mind

LESSONS = tuple(f"  teaches {skill} on Roam for 3 generations\n" for skill in ("Go", "Avoid", "Drive"))
OTHER_TASK = MIND.replace("task Roam", "task Walk").replace("on Roam", "on Walk")
FAR = "task Far in plain\n  contains ball is item size 1\n  lasts 90 ticks\n  rewards 10 on reach of ball\n\n"
# By hand: how all skills stand then, and whether training has something to do.
CHANGES = {
    "another name of the task": (OTHER_TASK, "trained", False),
    "another name, and something else": (OTHER_TASK.replace("rewards 10", "rewards 11"), "taught elsewhere", True),
    "another name, and no lesson": (
        OTHER_TASK.replace("".join(LESSONS).replace("Roam", "Walk"), LESSONS[0].replace("Roam", "Walk")),
        "trained",
        False,
    ),
    "something else": (MIND.replace("rewards 10", "rewards 11"), "taught elsewhere", True),
}


@pytest.mark.parametrize("change", CHANGES)
def test_all_say_the_same(mindc: Call, tmp_path: Path, change: str) -> None:
    text, word, is_due = CHANGES[change]
    path = write_mind(tmp_path)
    teach(path)
    path.write_text(text)
    said, found = mindc("status", path, "Go").out, mindc("lint", path)
    assert said.split()[1 : 1 + len(word.split())] == word.split()
    assert ("mindc train teaches it again" in found.out + found.err) == is_due
    subject = open_subject(path, load(path))
    assert any(map(subject.is_due, subject.graph.lessons)) == is_due
    if not is_due:
        assert "nothing to do" in mindc("train", path).err


def test_the_master_of_a_lesson_may_have_another_name_now(tmp_path: Path) -> None:
    """Its world is that of the lesson on the same task, and of no other, whoever is master there."""
    under = MIND.replace("curriculum", f"{FAR}curriculum").replace("Go on Roam", "Go on Roam under Drive")
    path = write_mind(tmp_path, under)
    teach(path)
    path.write_text(under.replace("Drive", "Steer") + "  teaches Go on Far under Steer for 3 generations\n")
    found = statuses(path)["Go"]
    assert isinstance(found, Trained)
    assert (found.changes, found.outdated) == ((), frozenset())
    path.write_text(under.replace("under Drive", "under Go"))
    found = statuses(path)["Go"]
    assert isinstance(found, Trained)
    assert (found.changes, found.outdated) == ((), frozenset()), "Drive is there, so it was another lesson"


def test_what_nothing_teaches_is_not_sent_to_train(mindc: Call, tmp_path: Path) -> None:
    path = write_mind(tmp_path)
    teach(path)
    path.write_text(MIND.replace(LESSONS[0], "").replace("rewards 10", "rewards 11"))
    found = mindc("lint", path)
    assert "No lesson teaches Go in this world: write one, or take back what has changed." in found.out + found.err


def test_status_names_a_lesson_that_is_due(mindc: Call, tmp_path: Path) -> None:
    path = write_mind(tmp_path)
    teach(path)
    path.write_text(MIND.replace("curriculum", f"{FAR}curriculum") + LESSONS[0].replace("Roam", "Far"))
    said = mindc("status", path, "Go").out.splitlines()
    assert said[0].split()[:2] == ["Go", "trained"]
    assert said[1].strip() == "lesson 4 of School is due, on Far"


@given(
    st.permutations(
        [*LESSONS, "  teaches Go on Roam for 4 generations\n", "  teaches Avoid on Roam for 5 generations\n"]
    )
)
def test_lessons_come_after_what_they_need(lessons: list[str]) -> None:
    text = MIND.replace("".join(LESSONS), "".join(lessons))
    graph = compile_source(Source("drive.mind", text)).graph
    assert graph
    has_weights = set[str]()
    for lesson in graph.lessons:
        assert needed_skills(graph, lesson) <= has_weights
        has_weights.add(lesson.skill)
    for skill in ("Go", "Avoid", "Drive"):
        said = [int(line.split()[-2]) for line in lessons if line.split()[1] == skill]
        taught = [each.generations for each in graph.lessons if each.skill == skill]
        assert said == taught, "what overtakes a lesson of its own skill would leave it untaught"
    assert chosen_lessons(graph, None, ("Drive", "Go")) == tuple(x for x in graph.lessons if x.skill != "Avoid")


@st.composite
def curricula(draw: st.DrawFn) -> str:
    """A mind of six skills, some above others, and lessons of them in any order, circles among them."""
    names, text = "ABCDEF", HEAD.replace("master Go", "master A")
    below: dict[str, str] = {}
    for place, name in reversed([*enumerate(names)]):
        chosen = draw(st.sets(st.sampled_from(names[place + 1 :]), max_size=2)) if place < 5 else set()
        below[name] = "".join(sorted(chosen))
        edges = "".join(f"  influences {each}\n" for each in below[name])
        text += f"skill {name} is mlp\n  reads eye\n  drives left\n{edges}"
    text += FAR + "curriculum C is genetic\n"
    for number in range(draw(st.integers(1, 12))):
        name = draw(st.sampled_from(names))
        others = [each for each in names if not below[name] and not below[each] and each != name]
        masters = [each for each in names if name in below[each]]
        under = f" under {draw(st.sampled_from(masters))}" if masters and draw(st.booleans()) else ""
        origin = f" from {draw(st.sampled_from(others))}" if others and draw(st.booleans()) else ""
        together = " with subskills" if draw(st.integers(0, 3)) == 0 else ""
        text += f"  teaches {name} on Far{under} for {number + 1} generations{origin}{together}\n"
    return text


@given(curricula())
@settings(max_examples=cases(200))
def test_the_order_is_that_of_the_first_lesson_that_waits_for_none(text: str) -> None:
    """Said the slow way: what a lesson waits for is asked anew of all that are left."""
    mind = compile_source(Source("c.mind", text)).mind
    assert mind, text
    edges = {skill.name: {edge.target for edge in skill.edges if edge.to == "skill"} for skill in mind.skills}

    def below(name: str) -> set[str]:
        return {name}.union(*map(below, edges[name]))

    left = sorted(mind.lessons, key=lambda lesson: lesson.generations)
    taught = {each.generations: below(each.skill) if each.with_subskills else {each.skill} for each in left}
    acting = {each.generations: below(each.master) | {each.starts_from} for each in left}
    known, order = set[str](), []
    while left:
        for place, lesson in enumerate(left):
            needs = acting[lesson.generations] - taught[lesson.generations] - known
            later = any(needs & taught[each.generations] for each in left)
            if not later and not any(taught[lesson.generations] & taught[each.generations] for each in left[:place]):
                break
        else:
            lesson = left[0]
        left.remove(lesson)
        known |= taught[lesson.generations]
        order.append(lesson)
    assert order == list(mind.lessons)
