"""What is declared and comes to nothing."""

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from mindrun.graph.named_readings import named_places
from networkx import DiGraph

from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Contains, File, Reads, Tick, Use, of_form
from mindlang.lint.study import Finding, Found, Study, readings, removal, rule
from mindlang.lock import LockError, lock_path
from mindlang.lock.blobs import load_weights
from mindlang.lock.signature import arrange
from mindlang.lock.status import Trained, status


@rule(elsewhere=True)
def unread_sensor(study: Study) -> Found:
    for part in study.mind.sensors:
        is_needed = study.is_exhausted and part.kind.battery
        if ("sensor", part.name) not in study.used and not is_needed:
            fix = removal(study.mind.names.table["sensor"][part.name], is_safe=True)
            hint = f"Add reads {part.name} to a skill, or take the sensor out."
            yield Finding(part.span, f"Nobody reads {part.name}.", hint, fix=fix)


@rule(elsewhere=True)
def undriven_actuator(study: Study) -> Found:
    for part in study.mind.actuators:
        if ("actuator", part.name) not in study.used:
            hint = f"Add drives {part.name} to a skill, or take the actuator out."
            message = f"Nobody drives {part.name}: it stays at {part.kind.neutral:g}."
            fix = removal(study.mind.names.table["actuator"][part.name])
            yield Finding(part.span, message, hint, fix=fix)


@rule(elsewhere=True)
def unreached_skill(study: Study) -> Found:
    for skill in study.mind.skills:
        if skill.name not in study.acting:
            fix = None if ("skill", skill.name) in study.used else removal(skill.declaration)
            hint = f"Write influences {skill.name} below a skill that acts, or take {skill.name} out."
            yield Finding(skill.span, f"No master reaches {skill.name}.", hint, fix=fix)


@rule(elsewhere=True)
def unused_memory(study: Study) -> Found:
    rewards = [reward for task in study.mind.tasks for reward in task.rewards]
    ends = [end.when for task in study.mind.tasks for end in task.ends]
    read = {
        *(name for skill in study.mind.skills for name in skill.reads),
        *(name for kind in study.sensors.values() for name in kind.sources),
        *(reward.each for reward in rewards if reward.each),
        *readings(*((reward.amount, reward.when) for reward in rewards), *ends),
    }
    driven = {edge.target for skill in study.mind.skills for edge in skill.edges if edge.to == "memory"}
    for part in study.mind.memories:
        name, cell = part.name, part.kind
        if name not in read:
            fix = None if name in driven else removal(study.mind.names.table["memory"][name], is_safe=True)
            hint = f"Add reads {name} to a skill, or take the memory out."
            yield Finding(part.span, f"Nobody reads {name}.", hint, fix=fix)
        elif name not in driven and not cell.changes_alone:
            hint = f"Add drives {name} to a skill, or take the memory out."
            yield Finding(part.span, f"Nobody drives {name}, so it is always {cell.start:g}.", hint)
        elif cell.is_fixed:
            hint = "Write decay 0 to take each command as it comes; drives … when … otherwise its own value holds it."
            yield Finding(part.span, f"With decay 1 no command changes {name}, so it is always {cell.start:g}.", hint)


@rule(elsewhere=True)
def unused_name(study: Study) -> Found:
    for name, number in study.mind.names.numbers.items():
        if ("number", name) not in study.used:
            fix = removal(number, f"Remove {name}", is_safe=True)
            yield Finding(number.name.span, f"Nothing says {name}.", "Say it somewhere, or take it out.", fix=fix)
    for name, scene in study.mind.names.declarations("scene"):
        if ("scene", name) not in study.used:
            hint = f"Write task NAME in {name}, or take it out."
            fix = removal(scene, is_safe=True)
            yield Finding(scene.header.name.span, f"No task is in {name}.", hint, fix=fix)


@rule()
def unused_reading(study: Study) -> Found:
    for skill in (skill for skill in study.mind.skills if not skill.function.has_outputs):
        used = readings(*((edge.at, edge.gate) for edge in skill.edges))
        for fact in of_form(skill.declaration.facts, Reads):
            if fact.name.text not in used:
                message = f"{skill.name} reads {fact.name.text}, but no value of it depends on that."
                hint = f"Use {fact.name.text} in a value after at, or take the line out."
                yield Finding(fact.span, message, hint, fix=removal(fact))
    yield from _unlinked(study)


def _unlinked(study: Study) -> Found:
    """What a skill reads whose network was taught, and no link leads from."""
    graph, states = arrange(study.graph, study.lock), status(study.graph, study.lock)
    places = named_places(graph)
    for skill in (each for each in graph.skills if each.function.grows and not each.like):
        state, unread = states[skill.name], set[int]()
        if isinstance(state, Trained):
            with suppress(LockError):
                unread = {
                    skill.inputs[n] for n in skill.function.unread(load_weights(state.entry, skill), skill.outputs)
                }
        for fact in of_form(study.skills[skill.name].declaration.facts, Reads):
            if unread.issuperset(places[fact.name.text]):
                edit = study.main.edit("disconnect", skill.name, fact.name.text, "--keep-weights")
                message = f"{skill.name} reads {fact.name.text}, and no link that it has learnt leads from there."
                yield Finding(fact.span, message, f"{edit} takes the line out, and leaves what was learnt.")


@rule(elsewhere=True)
def unused_task(study: Study) -> Found:
    used = {lesson.task for lesson in study.mind.lessons}
    for task in study.mind.tasks if used else ():
        if task.name not in used and not task.counts:
            hint = f"Add teaches SKILL on {task.name} for 1000 generations to a curriculum, or take the task out."
            yield Finding(task.span, f"No lesson is on {task.name}.", hint, fix=removal(task.declaration))


@rule(elsewhere=True)
def unused_thing(study: Study) -> Found:
    sensed, named = frozenset[str]().union(*study.senses.values()), _named(study)
    charges = any(kind.battery for kind in study.sensors.values())
    used: set[Span] = set()
    idle: dict[Span, Contains] = {}
    for task in study.mind.tasks:
        delivers = any(thing.kind.can_be_delivered for thing in task.things)
        about = {name for fact in task.facts for name in named.get(_place(fact.span), ())} | sensed
        facts = {fact.name.text: fact for fact in of_form(task.facts, Contains)}
        for thing in task.things:
            kind = thing.kind
            is_of_use = kind.is_solid or (kind.charges and charges) or (kind.takes_items and delivers)
            if thing.name in about or is_of_use:
                used.add(thing.span)
            else:
                idle[thing.span] = facts[thing.name]
    for span, fact in idle.items():
        if span not in used:  # by another task that has it from the same line
            name = fact.name.text
            hint = f"Reward or count something about {name}, let a sensor tell of it, or take it out."
            fix = removal(fact, f"Remove {name}")
            yield Finding(span, f"No sensor, reward or event is about {name}.", hint, fix=fix)


def _named(study: Study) -> dict[tuple[Source, int], list[str]]:
    """The things that a line of a task is about, by the place of the line; not the one that it contains."""
    own = {fact.name.span for task in study.mind.tasks for fact in of_form(task.facts, Contains)}
    found: dict[tuple[Source, int], list[str]] = {}
    for mention in study.mentions:
        if mention.noun == "thing" and mention.name.span not in own:
            found.setdefault(_place(mention.name.span), []).append(mention.name.text)
    return found


def _place(span: Span) -> tuple[Source, int]:
    return span.source, span.line


PASSIVE = {"sensor", "memory", "skill"}


@rule()
def unused_use(study: Study) -> Found:
    """Lines of the main file whose files, as far as no other line brings them, only declare what nobody names."""
    main, *others = study.mind.files
    known = {file.source.path: file for file in others}
    uses = of_form(main.settings, Use)
    used = {path: map(_path, of_form(file.settings, Use)) for path, file in known.items()}
    brings = DiGraph({path: [each for each in paths if each in known] for path, paths in used.items()})
    reach = [with_descendants(brings, {_path(use)} & known.keys()) for use in uses]
    for number, use in enumerate(uses):
        shared = {path for other, paths in enumerate(reach) if other != number for path in paths}
        brought = [known[path] for path in reach[number] - shared]
        if brought and not _is_used(study, brought):
            hint = "Take the line out, or use something of it."
            yield Finding(use.span, f"Nothing of {use.path} is used.", hint, fix=removal(use, is_safe=True))


def _path(use: Use) -> Path:
    return (use.span.source.folder / use.path).resolve()


def _is_used(study: Study, files: Iterable[File]) -> bool:
    sources = {id(file.source) for file in files}
    own = {(each.header.noun.text, each.header.name.text) for file in files for each in file.declarations}
    sensors = [study.sensors[name] for noun, name in own if noun == "sensor"]
    others = (file for file in study.mind.files if id(file.source) not in sources)
    named = {(each.noun, each.name.text) for each in study.mentions if id(each.name.span.source) not in sources}
    return (
        any(noun not in PASSIVE for noun, _ in own)
        or (study.is_exhausted and any(kind.battery for kind in sensors))
        or any(lock_path(file.source.path).exists() for file in files)
        or not any(of_form(file.settings, Tick) for file in others)
        or not named.isdisjoint(own)
    )
