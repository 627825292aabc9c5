"""Checks of minds whose tasks are Gymnasium environments: what makes sense there, and whether parts fit them."""

from collections.abc import Iterator, Sequence
from typing import Any

from mindrun.errors import MindError
from mindrun.kinds.bodies.body import BodyKind, Disc
from mindrun.kinds.registry import names as kind_names
from mindrun.kinds.sensors.sensor import Physical

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings, a
from mindlang.compiler.model import Part
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.worlds import RobotFacts
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Counts, Phrase, Starts, expressions_in, of_form

ENVIRONMENT = "a gymnasium environment"
OUTSIDE = {"task": ("gymnasium",), "sensor": ("observation", "observations"), "actuator": ("action", "choice")}  # kinds

Refused = tuple[Span, str, str]  # where, why, and what to do


def is_outside(names: Names) -> bool:
    """True if any task is in an environment, or a sensor or actuator belongs to one."""
    return any(
        (phrase := declaration.header.phrase) is not None and phrase.kind.text in kinds
        for noun, kinds in OUTSIDE.items()
        for _, declaration in names.declarations(noun)
    )


def body_outside(names: Names, findings: Findings) -> Part[BodyKind]:
    """A stand-in for the body, which the environment has itself; one that is declared is reported."""
    for _, declared in names.declarations("body"):
        message = f"{ENVIRONMENT.capitalize()} has a body of its own."
        findings.error("foreign-part", declared.header.span, message, "Leave the line out.")
    tasks = [declaration for noun in ("task", "sensor", "actuator") for _, declaration in names.declarations(noun)]
    return Part("", Disc(), tasks[0].header.span)


def check_outside(tasks: Sequence[model.Task], robot: RobotFacts, findings: Findings) -> None:
    """Report what means nothing in the worlds of the tasks: an environment's in others, others' in an environment."""
    known = [task for task in tasks if task.scene is not None]
    outside = [task for task in known if task.scene.environment]
    with findings.each_once():
        for task in known:
            _check_judged(task, findings)
        if not outside:
            for part in (part for part in robot.parts if part.kind.is_outside and known):
                message = f"{_kind(part)} belongs to {ENVIRONMENT}, and no task is in one."
                hint = "Write task Land in gymnasium LunarLanderContinuous-v3."
                findings.error("foreign-part", part.span, message, hint)
            return
        for task in (task for task in known if not task.scene.environment):
            message = f"{task.name} is in no environment, as {outside[0].name} is."
            hint = "The tasks of a mind are all in gymnasium, or none is: write this one in a file of its own."
            findings.error("mixed-scenes", task.declaration.header.span, message, hint)
        for span, message, hint in _foreign(outside, robot):
            findings.error("foreign-part", span, message, hint)
        several = {task.scene.environment: task for task in reversed(outside)}
        for name, task in several.items():
            _check_environment(task, robot, f"environment {name}" * (len(several) > 1), findings)


def _kind(part: Part[Any]) -> str:
    return a(kind_names()[type(part.kind)]).capitalize()


def _foreign(tasks: Sequence[model.Task], robot: RobotFacts) -> Iterator[Refused]:
    """The parts that need a body or a world of ours, and the lines of tasks that do: things, and where it starts."""
    for sensor in (each for each in robot.sensors if isinstance(each.kind, Physical) and not each.kind.is_outside):
        hint = f"Write which of its numbers it is: sensor {sensor.name} is observation 0 range -1 to 1."
        yield sensor.span, f"{_kind(sensor)} measures nothing in {ENVIRONMENT}.", hint
    for actuator in (each for each in robot.actuators if each.kind.moves_body or each.kind.can_hold):
        hint = f"Write what it takes: actuator {actuator.name} is action 0 neutral 0.5, or choice 0."
        yield actuator.span, f"{_kind(actuator)} does nothing in {ENVIRONMENT}.", hint
    for task in tasks:
        for thing in task.things:
            yield thing.span, f"Nothing can be put into {ENVIRONMENT}.", "Leave the line out."
        for fact in of_form(task.facts, Starts):
            yield fact.span, f"{ENVIRONMENT.capitalize()} says itself how a run begins.", "Leave the line out."


def _check_judged(task: model.Task, findings: Findings) -> None:
    """Report events and measures of another kind of world than the task's."""
    outside = bool(task.scene.environment)
    for kind, span in _judged(task):
        name = kind_names()[type(kind)]
        if outside and not (kind.is_outside or getattr(kind, "is_of_success", False)):
            hint = "There its reward can be rewarded, and its end: what else there is to know is a sensor's to observe."
            findings.error("foreign-outcome", span, f"Nobody says in {ENVIRONMENT} what {name} is.", hint)
        elif kind.is_outside and not outside:
            hint = f"{task.name} would have to be in one: task {task.name} in gymnasium LunarLanderContinuous-v3."
            findings.error("foreign-outcome", span, f"{name} is what {ENVIRONMENT} says.", hint)


def _judged(task: model.Task) -> Iterator[tuple[Any, Span]]:
    """The events and measures of a task, and where they stand."""
    events: list[tuple[Any, Phrase | None]] = [(end.event, end.fact.event) for end in task.ends]
    events += [(reward.on, reward.fact.on) for reward in task.rewards]
    events += zip(task.counts, (fact.event for fact in of_form(task.facts, Counts)), strict=True)
    yield from ((each, phrase.span) for event, phrase in events if event and phrase for each in event.single)
    computed = *(end.when for end in task.ends), *((reward.amount, reward.when) for reward in task.rewards)
    measured = (term for expression in expressions_in(*computed) for term in expression.found("measure"))
    yield from ((term.operand, term.span) for term in measured)


def _check_environment(task: model.Task, robot: RobotFacts, which: str, findings: Findings) -> None:
    """Report what does not fit the spaces of an environment; nothing where it cannot be asked on this machine.

    `which` says which one it is, where there are others. One that has its module before it is not asked: that would run
    the text of the module.
    """
    from mindrun.sim.outside import making

    name, header = task.scene.environment, task.declaration.header
    if ":" in name or not making.is_there():
        return
    try:
        from mindrun.sim.outside.subprocess_stepper import known_spaces  # which needs numpy

        spaces = known_spaces(name)
    except making.UnknownEnvironmentError as error:
        findings.error(
            "unknown-environment", header.phrase.span if header.phrase else header.span, str(error), error.hint
        )
        return
    except (ImportError, MindError):
        return  # what it needs is not installed here: a run says so
    from mindrun.sim.outside.wiring import misfits

    spans = {part.name: part.span for part in robot.parts} | {"": header.span}
    ours = (
        {part.name: slot for part in parts if (slot := part.kind.slot)} for parts in (robot.sensors, robot.actuators)
    )
    for found in misfits(spaces, *ours):
        message = found.message.replace("environment", which or "environment", 1)
        findings.error(found.code, spans[found.name], message, found.hint)
