"""Files → Mind: names found, kinds built, units converted, and everything that is wrong reported."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from mindrun.kinds.bodies.body import BodyKind
from mindrun.numbers.quantity import LENGTH_OF_UNIT, TICK, Quantity
from msgspec.structs import replace

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.expand import expand, fill_number, number_values, number_writer
from mindlang.compiler.hierarchy import refuse_circles
from mindlang.compiler.names import Names, declared_names
from mindlang.compiler.resolve.curricula import lessons
from mindlang.compiler.resolve.goals import with_goals
from mindlang.compiler.resolve.outside import body_outside, check_outside, is_outside
from mindlang.compiler.resolve.parts import check_drives, memory_widths, resolve_parts, sensors
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.resolve.skills import skills
from mindlang.compiler.resolve.tasks import resolve_tasks
from mindlang.compiler.resolve.worlds import RobotFacts
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Amount, File, Master, Setting, Tick, Unit, Version, of_form

LANGUAGE_VERSION = 1
ONWARDS = "and from there on"  # of the lines of a circle

D = TypeVar("D", model.Skill, model.Task)
S = TypeVar("S", bound=Setting)


def resolve_mind(files: Sequence[File], findings: Findings) -> model.Mind | None:
    """The mind that the files declare, the main one first; None when anything in them is wrong."""
    all_read = not findings.diagnostics
    written = declared_names(files, findings)
    values = number_values(written, findings)
    tick = _agreed(files, Tick, TICK, values, findings) or 1.0
    unit = _agreed(files, Unit, LENGTH_OF_UNIT, values, findings)
    _check_versions(files, findings)
    names = expand(written, values, tick, findings)
    names = with_goals(names, number_writer(names, values, tick), tick, findings)
    memories, actuators = resolve_parts("memory", names, findings), resolve_parts("actuator", names, findings)
    known_sensors = sensors(names, memories, findings)
    width = dict.fromkeys(names.of("sensor"), 1) | memory_widths(names, memories)
    width |= {each.name: each.width for each in known_sensors}
    known_skills = skills(names, width, findings)
    influences = model.influence_graph(known_skills)
    says, hint = "Skills influence one another in a circle", "Influence flows one way, from the master down"
    refuse_circles("influence-cycle", influences, findings, says, f"{hint}: take one of these lines out.", ONWARDS)
    body = body_outside(names, findings) if (outside := is_outside(names)) else _body(names, findings)
    robot = RobotFacts(names, width, tick, files[0].source.folder, body, actuators, known_sensors)
    known_tasks = resolve_tasks(robot, findings)
    check_outside(known_tasks, robot, findings)
    known_lessons = tuple(lessons(robot, known_skills, influences, known_tasks, findings))
    if body and not outside:
        check_drives(body, actuators, findings)
    head = _master(files[0], names, findings)
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
    return (replace(each, declaration=names.table[noun][each.name]) for each in declared)


def _settings(files: Iterable[File], form: type[S]) -> list[S]:
    return [setting for file in files for setting in of_form(file.settings, form)]


def _agreed(
    files: Sequence[File], form: type[Tick | Unit], quantity: Quantity, values: Mapping[str, Amount], findings: Findings
) -> float | None:
    """The value of a setting, on which all files agree; None where nothing says it."""
    word = form.__name__.lower()
    first: tuple[float, Span] | None = None
    for setting in _settings(files, form):
        value = convert(fill_number(setting.amount, values), quantity, findings)
        if value and first and value != first[0]:
            message, places = f"The {word} differs from the one said before.", (first[1], setting.span)
            findings.refuse_again(f"{word}-differs", places, message, f"Use one {word}.")
        if value and not first:
            first = value, setting.span
    return first[0] if first else None


def _master(file: File, names: Names, findings: Findings) -> str:
    """The master of the main file; those of used files do not count."""
    found = _settings([file], Master)
    hint = "Leave one of the two lines out."
    findings.refuse_again("second-master", [each.span for each in found], "A mind has one master.", hint)
    for setting in found[:1]:
        names.find(setting.name, ("skill",), findings)
    return found[0].name.text if found else ""


def _check_versions(files: Sequence[File], findings: Findings) -> None:
    """Report files that were written for another language than this one."""
    for setting in _settings(files, Version):
        amount = setting.amount
        if (amount.number, amount.unit, amount.per, amount.name) != (LANGUAGE_VERSION, "", "", ""):
            message = f"This is mind {LANGUAGE_VERSION}, and the file says {setting.span.text.strip()}."
            hint = f"Write mind {LANGUAGE_VERSION}, or take the mindc for which the file was written."
            findings.error("other-version", setting.span, message, hint)


def _body(names: Names, findings: Findings) -> model.Part[BodyKind] | None:
    declared = [each.header.span for _, each in names.declarations("body")]
    findings.refuse_again("second-body", declared, "A mind has one body.", "Leave one of the two out.", "the first one")
    return next(iter(resolve_parts("body", names, findings)), None)


def _check_complete(
    files: Sequence[File], names: Names, known_skills: tuple[model.Skill, ...], has_body: bool, findings: Findings
) -> None:
    """Report what every mind needs and this one lacks."""
    below = {name for skill in known_skills for name in skill.subskills}
    top = next((skill.name for skill in known_skills if skill.name not in below), "SKILL")
    needs = (
        (bool(_settings(files, Tick)), "no-tick", "how long a tick is", "tick 1/60 s"),
        (bool(_settings(files[:1], Master)), "no-master", "which skill is the master", f"master {top}"),
        (has_body or bool(names.of("body")), "no-body", "which body the robot has", "body Robot is disc size 2"),
    )
    start = Span(files[0].source, 0, 0)
    for there, code, what, line in needs:
        if not there:
            findings.error(code, start, f"The file does not say {what}.", f"Add the line {line}.")
