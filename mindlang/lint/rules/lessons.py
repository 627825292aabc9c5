"""Lessons that teach nobody, too early, twice, or in a world that lacks something; weights of something else."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from mindrun.graph.skill_sets import genes, learners
from mindrun.kinds.learners import Learner
from mindrun.kinds.sensors.sensor import Physical
from mindrun.terminal.command_line import command_line

from mindlang.compiler.diagnostic import Label, listed
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Lesson, Skill
from mindlang.lint.study import Finding, Found, Study, removal, rule
from mindlang.lock.status import Trained, mismatches, status

Readers = dict[str, tuple[str, str]]  # by thing: a skill and the sensor about the thing that it reads


@rule()
def absent_thing(study: Study) -> Found:
    readers = _readers(study) if study.mind.lessons else {}
    things = {task.name: {thing.name for thing in task.things} for task in study.mind.tasks}
    known: dict[str, set[str]] = {}
    for lesson in study.mind.lessons:
        known.setdefault(lesson.skill, set()).update(things[lesson.task])
    for lesson in study.mind.lessons:
        for thing, (skill, sensor) in readers[lesson.master].items():
            if thing not in known[lesson.skill]:
                having = [task for task, there in things.items() if thing in there]
                hint = f"Teach it on {listed(having[:3])}, or let {lesson.task} contain {thing}, too."
                message = f"{skill} reads {sensor}, but {lesson.task} contains no {thing}."
                label = Label(study.tasks[lesson.task].span, "this world")
                yield Finding(lesson.fact.task.span, message, hint, (label,))


def _readers(study: Study) -> dict[str, Readers]:
    """By skill, the things that it and those below it sense, each with a skill and a sensor that do."""
    found: dict[str, Readers] = {}
    for skill in study.children_first:
        own: Readers = {}
        for name in skill.subskills:
            own |= found[name]
        sensed = ((thing, name) for name in skill.reads for thing in sorted(study.senses.get(name, ())))
        own |= {thing: (skill.name, sensor) for thing, sensor in sensed}
        found[skill.name] = own
    return found


@rule()
def early_lesson(study: Study) -> Found:
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


@rule()
def frozen_lesson(study: Study) -> Found:
    for lesson in study.mind.lessons:
        taught = with_descendants(study.mind.influences, [lesson.skill]) if lesson.with_subskills else {lesson.skill}
        if taught.isdisjoint(study.learning):
            also = " and so do all that learn below it" * lesson.with_subskills
            hint = f"{study.main.edit('unfreeze', lesson.skill)} lets it learn again; else take the lesson out."
            message = f"{lesson.skill} stays frozen{also}: this lesson teaches nobody."
            fix = removal(lesson.fact, "Remove the lesson")
            yield Finding(lesson.fact.skill.span, message, hint, fix=fix)


LONG_GENERATIONS = 300  # what was taught for 100 lost little


@rule()
def noiseless_lesson(study: Study) -> Found:
    for written, lesson in zip(study.mind.lessons, study.graph.lessons, strict=True):
        if not study.mind.unit_metres or lesson.generations < LONG_GENERATIONS:
            continue
        read = _read_by(study, learners(study.graph, lesson))
        measured = (part for part in study.mind.sensors if part.name in read)
        noise = {part.name: part.kind.noise for part in measured if isinstance(part.kind, Physical)}
        varies = {(each.of, each.argument) for each in study.tasks[lesson.task].varies}
        if noise and not any(much or (name, "noise") in varies for name, much in noise.items()):
            taught = f"{lesson.skill} is taught for {lesson.generations:,} generations without noise, for a robot."
            hint = f"Write noise 2% in the line of {next(iter(noise))}, or as much as the real sensor has."
            yield Finding(written.fact.span, taught, hint)


def _read_by(study: Study, names: Iterable[str]) -> set[str]:
    """The sensors and memories that skills read, and those from which these are computed at last."""
    reads = {reading for name in names for reading in study.skills[name].reads}
    return {root for reading in reads for root in study.roots.get(reading, ())}


Said = tuple[str, str, str, str, bool, Learner]


@rule()
def repeated_lesson(study: Study) -> Found:
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


MORE_HINT = "Write more generations: for 100 generations."
HINT = "Leave it out: what the learner does where nothing is said is what has learnt best."


@rule()
def standing_learner(study: Study) -> Found:
    skills = {skill.name: skill for skill in study.graph.skills}
    for written, lesson in zip(study.mind.lessons, study.graph.lessons, strict=True):
        weights = sum(genes(skills[name]) for name in learners(study.graph, lesson))
        if weights and (why := lesson.learner.standstill(weights, lesson.generations)):
            yield Finding(written.fact.span, f"{why}.", HINT if lesson.generations > 1 else MORE_HINT)


@rule()
def task_without_reward(study: Study) -> Found:
    for lesson in study.mind.lessons:
        task = study.tasks[lesson.task]
        if all(study.worlds[task.name].why_never_paid(reward) for reward in task.rewards):
            label = Label(task.span, "declared here")
            rewards = "never pays a reward" if task.rewards else "rewards nothing"
            message = f"{task.name} {rewards}, so {lesson.skill} has nothing to learn for."
            hint = f"Add for example rewards 0.01 * forward per tick to {task.name}."
            yield Finding(lesson.fact.task.span, message, hint, (label,))


@rule()
def unmet_silence(study: Study) -> Found:
    taught = {learner for lesson in study.graph.lessons for learner in learners(study.graph, lesson)}
    read = _read_by(study, taught)
    for part in study.mind.sensors:
        kind = part.kind
        is_none = kind.shape and not any(kind.numbers)  # nothing is lost, and neutral is none of several
        if kind.is_order and part.name in read and is_none:
            said = f"{part.name} is one of several in every task, and on the robot none until somebody says one."
            hint = "Write lost 10%, so that what learns meets that, or one of them as neutral 1."
            yield Finding(part.span, said, hint)


@rule(elsewhere=True)
def untaught_skill(study: Study) -> Found:
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


@rule()
def stale_weights(study: Study) -> Found:
    """Skills that the lock knows with another signature; notes on subskills, as `mindc status` has them, are none."""
    for skill in study.graph.skills:
        entry = study.lock.get(skill.name)
        if entry and skill.function.learns and not skill.like and (found := mismatches(study.graph, skill, entry)):
            first = f"Unfreeze {skill.name} first: then " if skill.frozen else ""
            message = f"The weights of {skill.name} are stale: {'; '.join(found)}."
            yield Finding(study.skills[skill.name].span, message, f"{first}mindc train teaches it again.")


@rule()
def taught_elsewhere(study: Study) -> Found:
    for name, state in status(study.graph, study.lock, study.main.folder).items():
        if isinstance(state, Trained) and state.is_elsewhere and not study.skills[name].like:
            message = f"{name} was taught elsewhere: {'; '.join(state.changes)}."
            accept = command_line("mindc", "status", Path(study.main.path.name), "--accept", name)
            hint = f"mindc train teaches it again; {accept} leaves it as it is."
            if not state.outdated:
                hint = f"No lesson teaches {name} in this world: write one, or take back what has changed."
            yield Finding(study.skills[name].span, message, hint)
