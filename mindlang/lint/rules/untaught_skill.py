"""A skill that learns, but that no lesson teaches.

It has no weights, so no hierarchy with it can run. Give it a lesson, or let a lesson above it teach it `with
subskills`; one that has been taught elsewhere and is not to change `stays frozen`.
"""

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Skill
from mindlang.lint.examples import LEARNS, REWARDED, SCHOOL
from mindlang.lint.study import Finding, Found, Study

ELSEWHERE = True
UNTAUGHT = f"{LEARNS}  drives right_wheel\n{REWARDED}"
GOOD = (
    UNTAUGHT + SCHOOL,
    UNTAUGHT.replace("  reads eye", "  stays frozen\n  reads eye"),
)
BAD = UNTAUGHT


def check(study: Study) -> Found:
    """Active skills that learn and are in no lesson; where there is no lesson at all this is said once."""
    lessons = study.mind.lessons
    jointly = with_descendants(study.mind.influences, {lesson.skill for lesson in lessons if lesson.with_subskills})
    taught = {study.skills[name].owner for name in jointly} | {lesson.skill for lesson in lessons}
    names = (study.learning & study.acting) - taught - study.lock.keys()
    untaught = [skill for skill in study.mind.skills if skill.name in names]
    if lessons:
        for skill in untaught:
            hint = f"Add {_lesson(study, skill)} to a curriculum, or let it stay frozen."
            yield Finding(skill.span, f"No lesson teaches {skill.name}.", hint)
    elif own := [skill for skill in untaught if skill.span.source is study.main]:
        some = [skill.name for skill in own]
        some = some if len(some) < 4 else [*some[:2], f"{len(some) - 2} others"]
        message = f"There is no lesson, but {listed(some, 'and')} {'learns' if len(own) == 1 else 'learn'}."
        yield Finding(own[0].span, message, f"Add a curriculum: {_lesson(study, own[0])}.")


def _lesson(study: Study, skill: Skill) -> str:
    task = skill.name if skill.name in study.tasks else next(iter(study.tasks), "TASK")
    return f"teaches {skill.name} on {task} for 1000 generations"
