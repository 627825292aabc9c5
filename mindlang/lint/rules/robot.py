"""What a robot is made of, and whether it fits its world."""

from collections.abc import Iterable, Iterator
from decimal import Decimal
from itertools import combinations
from math import hypot
from typing import Any

from mindrun.kinds.actuators.actuator import THRUST, ActuatorKind
from mindrun.kinds.registry import arguments, kinds
from mindrun.numbers.quantity import Quantity, fits

from mindlang.compiler.diagnostic import Label, listed
from mindlang.compiler.model import Part
from mindlang.compiler.syntax import Amount, Argument, Declaration, Name, Numbers, Phrase, Tick, Use, of_form
from mindlang.lint.study import Finding, Found, Study, rule, saying
from mindlang.lint.top_speed import farthest_step


@rule()
def bare_rate(study: Study) -> Found:
    main, *others = study.mind.files
    uses = {(use.span.source.folder / use.path).resolve(): use for use in reversed(of_form(main.settings, Use))}
    for file in (file for file in others if not of_form(file.settings, Tick)):
        use = uses.get(file.source.path)
        bare = [rate for each in file.declarations for rate in _rates(each) if not _tells_time(study, rate)]
        if use and bare:
            labels = (Label(argument.span, "for each tick, however long that is") for argument in bare)
            hint = "Write there how much it is in a second, such as drain 0.003 per s, or add per tick."
            yield Finding(use.span, f"What {use.path} says for each tick depends on the tick here.", hint, (*labels,))


def _rates(declaration: Declaration) -> Iterator[Argument]:
    phrase = declaration.header.phrase
    cls = kinds(declaration.header.noun.text).get(phrase.kind.text) if phrase else None
    if phrase and cls:
        rates = {each.key for each in arguments(cls) if isinstance(each.type, Quantity) and each.type.rate}
        yield from (argument for argument in phrase.arguments if argument.key.text in rates)


def _tells_time(study: Study, argument: Argument) -> bool:
    """True if a rate says per which time it is, itself or where its number is declared."""
    match argument.value:
        case Numbers(amounts=(Amount(per=per, name=""),)):
            return bool(per)
        case Numbers(amounts=(Amount(name=name),)) | Name(text=name):
            return bool(study.mind.numbers[name][2])
    return True


MOST_SIZES = 0.75  # of its lesser side


@rule()
def coarse_tick(study: Study) -> Found:
    graph, body = study.graph, study.mind.body
    far, task = farthest_step(graph)
    size = 2 * min(graph.body.front, graph.body.side)
    if far > MOST_SIZES * size:
        moves = f"{body.name} moves {far:.3g} units in a tick of {task}"
        share = MOST_SIZES * size / far
        hint = f"Give it at most {share:.2g} of its thrust, a shorter tick, more density or more linear_damping."
        yield Finding(body.span, f"At full thrust {moves}, {far / size:.2g} times its size.", hint)


LEAST_SINE = 1e-6  # of the angle between two directions
LACKS = {
    "steering": ("drives a car that nothing steers: it stays on one line.", "Add an actuator that is steering."),
    "motor": ("steers a car that nothing drives: it stands still.", "Add an actuator that is motor."),
}


@rule()
def half_driven_body(study: Study) -> Found:
    body, moving = study.mind.body.kind, [part for part in study.mind.actuators if part.kind.drive]
    there = {part.kind.drive for part in moving}
    if "steering" in body.drives and len(there) == 1:
        for drive, (message, hint) in LACKS.items():
            if drive not in there:
                yield Finding(moving[0].span, f"{moving[0].name} {message}", hint)
    elif body.drives == ("thruster",) and moving and not _is_planar(study, moving):
        last, name = moving[-1], study.mind.body.name
        message = f"{last.name} and all other thrusters push along one line, and {name} stays on it."
        if len(moving) == 1:
            message = f"{last.name} is the only thruster, and {name} moves along one line alone."
        yield Finding(last.span, message, "Add a thruster that is facing elsewhere, or turn one: facing 90 deg.")


def _is_planar(study: Study, thrusters: list[Part[ActuatorKind]]) -> bool:
    rows = [part.kind.row(study.mind.body.kind) for part in thrusters]
    crossed = (a["ahead"] * b["aside"] - a["aside"] * b["ahead"] for a, b in combinations(rows, 2))
    return any(abs(sine) > LEAST_SINE for sine in crossed)


@rule()
def one_sided_wheels(study: Study) -> Found:
    wheels = [(part, part.kind.mounted) for part in study.mind.actuators if part.kind.mounted]
    sides = {side for _, side in wheels}
    if len(wheels) > 1 and len(sides) == 1:
        (first, side), (last, _) = wheels[0], wheels[-1]
        other = "right" if side == "left" else "left"
        label = Label(first.span, "so is this one")
        hint = f"Write side {other} in one of them."
        yield Finding(last.span, f"{last.name} is on the {side}, and so are all wheels.", hint, (label,))


LEAST_SHARE = 0.2  # of a range that a world uses


@rule()
def unsaid_range(study: Study) -> Found:
    graph = study.graph
    speed = farthest_step(graph)[0] / graph.tick
    rooms = [task.scene.sides for task in graph.tasks]
    for sensor in study.mind.sensors:
        (low, high), unsaid = sensor.kind.ends, _phrases_without(study, "sensor", [sensor], "range")
        if not high or not unsaid or not speed:
            continue
        far = max(max(sides) / 2 if low else hypot(*sides) for sides in rooms)
        most, unit = (speed, " a second") if sensor.kind.unit == "m/s" else (far, "")
        if most < LEAST_SHARE * high:
            message = f"{sensor.name} measures up to {high:g} units{unit}, and here are no more than {_short(most)}."
            hint = f"Add range {_short(most)}: it reads its whole 0 to 1 then."
            yield Finding(sensor.span, message, hint, fix=saying(unsaid, f"range {_short(most)}"))


LEAST_LENGTHS, PROPOSED_LENGTHS, MOST_LENGTHS = 0.25, 2.0, 10.0  # a second
TOO_LARGE = "No thrust is that large: write lengths in a larger unit, such as 0.2 in metres for 200 in millimetres."


@rule()
def unsaid_thrust(study: Study) -> Found:
    graph, body = study.graph, study.mind.body
    pushing = [part for part in study.mind.actuators if "thrust" in part.kind.varying]
    unsaid = _phrases_without(study, "actuator", pushing, "thrust")
    varied = any(each.argument == "thrust" for task in graph.tasks for each in task.varies)
    speed, length = farthest_step(graph)[0] / graph.tick, 2 * graph.body.front
    if not speed or varied or len(unsaid) < len(pushing) or LEAST_LENGTHS <= speed / length <= MOST_LENGTHS:
        return
    default = float(pushing[0].kind.row(graph.body)["thrust"])  # that of all: wheels and thrusters have the same
    thrust = default * PROPOSED_LENGTHS * length / speed
    names = listed([part.name for part in pushing], "and")
    pace = f"{_short(speed, 3)} units a second, {_short(speed / length)} times its length"
    message = f"At full thrust {body.name} goes {pace}, with a thrust of {default:g} that nobody says."
    if not fits(THRUST, thrust):
        yield Finding(pushing[0].span, message, TOO_LARGE)
        return
    hint = f"Add thrust {_short(thrust)} to {names}: {PROPOSED_LENGTHS:g} times its length a second."
    yield Finding(pushing[0].span, message, hint, fix=saying(unsaid, f"thrust {_short(thrust)}"))


def _phrases_without(study: Study, noun: str, parts: Iterable[Part[Any]], argument: str) -> list[Phrase]:
    """The kinds of some parts as they are written, of those that do not say an argument."""
    phrases = (study.mind.names.table[noun][part.name].header.phrase for part in parts)
    return [each for each in phrases if each and all(said.key.text != argument for said in each.arguments)]


def _short(value: float, digits: int = 2) -> str:
    """A number of so many digits as the language writes it, without an exponent."""
    return f"{Decimal(f'{value:.{digits}g}'):f}"
