"""Files → Mind: names found, kinds built, units converted, and everything that is wrong reported."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from mindrun.kinds.bodies.body import BodyKind
from msgspec.structs import replace

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.expand import expand, numbers
from mindlang.compiler.hierarchy import check_cycles
from mindlang.compiler.names import Names, gather
from mindlang.compiler.resolve.curricula import lessons
from mindlang.compiler.resolve.drives import check_drives
from mindlang.compiler.resolve.outside import body_outside, check_outside, is_outside
from mindlang.compiler.resolve.parts import parts, sensors
from mindlang.compiler.resolve.settings import check_versions, master, settings, tick_seconds, unit_metres
from mindlang.compiler.resolve.skills import skills
from mindlang.compiler.resolve.tasks import RobotFacts, tasks
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import File, Master, Tick

D = TypeVar("D", model.Skill, model.Task)


def resolve(files: Sequence[File], findings: Findings) -> model.Mind | None:
    """The mind that the files declare, the main one first; None when anything in them is wrong."""
    all_read = not findings.diagnostics
    written = gather(files, findings)
    values = numbers(written, findings)
    tick, unit = tick_seconds(files, values, findings), unit_metres(files, values, findings)
    check_versions(files, findings)
    names = expand(written, values, tick, findings)
    known_sensors = sensors(names, findings)
    width = dict.fromkeys(names.of("sensor", "memory"), 1) | {each.name: each.width for each in known_sensors}
    memories, actuators = parts("memory", names, findings), parts("actuator", names, findings)
    known_skills = skills(names, width, findings)
    influences = model.influence_graph(known_skills)
    check_cycles(influences, findings)
    body = body_outside(names, findings) if (outside := is_outside(names)) else _body(names, findings)
    robot = RobotFacts(names, width, tick, files[0].source.folder, body, actuators, known_sensors)
    known_tasks = tasks(robot, findings)
    check_outside(known_tasks, known_sensors, actuators, findings)
    known_lessons = tuple(lessons(names, known_skills, influences, known_tasks, width, findings))
    if body and not outside:
        check_drives(body, actuators, findings)
    head = master(files[0], names, findings)
    if all_read:
        _check_complete(files, names, known_skills, bool(body), findings)
    if findings.diagnostics or body is None:
        return None
    return model.Mind(
        tick,
        head,
        body,
        known_sensors,
        memories,
        actuators,
        tuple(_as_written(known_skills, "skill", written)),
        tuple(_as_written(known_tasks, "task", written)),
        known_lessons,
        tuple(files),
        written,
        influences,
        {name: (amount.number, amount.unit, amount.per) for name, amount in values.items()},
        unit,
    )


def _as_written(declared: Iterable[D], noun: str, names: Names) -> Iterator[D]:
    """Skills or tasks with the declarations that stand in their files: edits change these."""
    for each in declared:
        written = names.table[noun][each.name]
        yield each if each.declaration is written else replace(each, declaration=written)


def _body(names: Names, findings: Findings) -> model.Part[BodyKind] | None:
    declared = list(names.declarations("body"))
    for _, again in declared[1:]:
        first = Label(declared[0][1].header.span, "the first one")
        findings.error("second-body", again.header.span, "A mind has one body.", "Leave one of the two out.", first)
    return next(iter(parts("body", names, findings)), None)


def _check_complete(
    files: Sequence[File], names: Names, known_skills: tuple[model.Skill, ...], has_body: bool, findings: Findings
) -> None:
    """Report what every mind needs and this one lacks."""
    below = {name for skill in known_skills for name in skill.subskills}
    top = next((skill.name for skill in known_skills if skill.name not in below), "SKILL")
    needs = (
        (any(settings(file, Tick) for file in files), "no-tick", "how long a tick is", "tick 1/60 s"),
        (bool(settings(files[0], Master)), "no-master", "which skill is the master", f"master {top}"),
        (has_body or bool(names.of("body")), "no-body", "which body the robot has", "body Robot is disc size 2"),
    )
    start = Span(files[0].source, 0, 0)
    for there, code, what, line in needs:
        if not there:
            findings.error(code, start, f"The file does not say {what}.", f"Add the line {line}.")
