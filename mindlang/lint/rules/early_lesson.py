"""Lessons that wait for each other, of which none can come first.

Lessons stand in any order: those are taught first that teach what acts in others, or what others begin `from`. A lesson
under a master runs the whole hierarchy below it, so it waits for all of these. Where that closes a circle, none of them
has the weights that it needs: let one lesson teach a skill without the others.
"""

from collections import Counter
from collections.abc import Mapping, Sequence

from mindlang.compiler.diagnostic import Label
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Lesson
from mindlang.lint.examples import LEARNS, LESSON, REWARDED
from mindlang.lint.study import Finding, Found, Study
from mindlang.lock.status import mismatches

LIVE = "master Live\nskill Live is mlp\n  reads eye\n  influences Go\n  drives left_wheel\n"
HIERARCHY = f"{LIVE}{LEARNS}{REWARDED}curriculum School is genetic\n"
SECOND_LESSON = "  teaches Live on Course for 10 generations\n"
LESSON_AT_WORK = "  teaches Go on Course under Live for 10 generations\n"
GOOD = (
    HIERARCHY + SECOND_LESSON + LESSON,
    f"{HIERARCHY}  teaches Live on Course for 10 generations with subskills\n{LESSON}",
)
BAD = (HIERARCHY + SECOND_LESSON + LESSON_AT_WORK,)


def check(study: Study) -> Found:
    courses: dict[str, list[Lesson]] = {}
    for lesson in study.mind.lessons:
        courses.setdefault(lesson.curriculum, []).append(lesson)
    firsts = {curriculum: _firsts(study, lessons) for curriculum, lessons in courses.items()}
    taught_in = Counter(skill for first in firsts.values() for skill in first)
    for curriculum, lessons in courses.items():
        first = {skill: place for skill, place in firsts[curriculum].items() if taught_in[skill] == 1}
        yield from _early(study, lessons, first)


def _firsts(study: Study, lessons: Sequence[Lesson]) -> dict[str, int]:
    """The place of the first lesson that teaches each skill."""
    found: dict[str, int] = {}
    unseen = study.mind.influences.copy()
    for place, lesson in enumerate(lessons):
        taught = {lesson.skill}
        if lesson.with_subskills:
            taught = with_descendants(unseen, taught & unseen.nodes)
            unseen.remove_nodes_from(taught)
        for skill in {study.skills[name].owner for name in taught} & study.learning:
            found.setdefault(skill, place)
    return found


def _early(study: Study, lessons: Sequence[Lesson], first: Mapping[str, int]) -> Found:
    latest: dict[str, tuple[int, str]] = {}  # of the first lessons of a skill and those below it, the last, and whose
    for each in study.children_first:
        latest[each.name] = max([(first.get(each.owner, -1), each.owner), *(latest[name] for name in each.subskills)])
    for place, lesson in enumerate(lessons):
        needed, skill = latest[lesson.master]
        role = "acts in this lesson"
        if lesson.starts_from and first.get(origin := study.skills[lesson.starts_from].owner, -1) > needed:
            needed, skill, role = first[origin], origin, "it begins with"
        if needed > place and not _has_weights(study, skill):
            message = f"{lesson.skill} waits for {skill}, which {role}, and {skill} waits for {lesson.skill}."
            label = Label(lessons[needed].fact.span, f"{skill} is taught here")
            yield Finding(
                lesson.fact.span, message, f"Add a lesson that teaches {skill} without {lesson.skill}.", (label,)
            )


def _has_weights(study: Study, name: str) -> bool:
    """True if the lock has weights that fit the skill."""
    entry = study.lock.get(name)
    return entry is not None and not mismatches(study.graph, study.graph.skills[study.graph.skill_numbers[name]], entry)
