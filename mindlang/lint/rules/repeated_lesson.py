"""A lesson that stands twice in a curriculum.

Right after itself it goes on where it ended: one lesson with more generations says so plainly. And one that begins from
scratch throws away what the same lesson taught before. Lessons that take turns with others are fine.
"""

from mindrun.kinds.learners import Learner

from mindlang.compiler.diagnostic import Label
from mindlang.compiler.model import Lesson
from mindlang.lint.examples import LEARNS, LESSON, REWARDED, TURN
from mindlang.lint.study import Finding, Found, Study

MIND = f"{LEARNS}  influences Turn\n{TURN}{REWARDED}"
SCHOOL = f"{MIND}curriculum School is genetic\n  teaches Turn on Course for 10 generations\n"
UNDER = "  teaches Turn on Course under Go for 10 generations\n"
GOOD = SCHOOL + LESSON + UNDER + LESSON + UNDER
BAD = (SCHOOL + LESSON + LESSON, SCHOOL + LESSON + UNDER + LESSON.replace("\n", " from scratch\n"))

Said = tuple[str, str, str, str, bool, Learner]


def check(study: Study) -> Found:
    first: dict[Said, Lesson] = {}
    before: Said | None = None
    for lesson in study.mind.lessons:
        said = (lesson.curriculum, lesson.skill, lesson.task, lesson.master, lesson.with_subskills, lesson.learner)
        earlier = first.setdefault(said, lesson)
        anew = lesson.from_scratch or lesson.starts_from
        if earlier is not lesson and (anew or said == before):
            message = f"This curriculum has taught {lesson.skill} on {lesson.task} already."
            hint = "Leave one of the two out, and give the other the generations of both."
            if anew:
                hint = "Leave one of the two out: this one throws away what the first has taught."
            yield Finding(lesson.fact.span, message, hint, (Label(earlier.fact.span, "first taught here"),))
        before = said
