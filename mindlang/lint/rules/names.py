"""Names that say something else than what they name."""

import re
from collections.abc import Iterator
from math import sin

from mindrun.kinds.registry import arguments, kinds

from mindlang.compiler.diagnostic import Label
from mindlang.compiler.names import introductions
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Name
from mindlang.lint.study import Finding, Found, Study, name_words, rule


@rule()
def hidden_measure(study: Study) -> Found:
    measures = {name for name, kind in kinds("measure").items() if not any(a.required for a in arguments(kind))}
    parts = [*study.mind.names.declarations("sensor"), *study.mind.names.declarations("memory")]
    for name in (declaration.header.name for name, declaration in parts if name in measures):
        hint = f"Give it another name: {study.main.edit('rename', name.text, 'NAME')}"
        yield Finding(name.span, f"{name.text} hides the measure of that name in rewards.", hint)


EVERYDAY = {
    "arena", "battery", "cell", "contact", "disc", "genetic", "held", "inside", "item", "mirrored", "plain", "rule",
    "turned", "zone",
}  # fmt: skip


@rule()
def misleading_name(study: Study) -> Found:
    outside = {sensor.name for sensor in study.mind.sensors if sensor.kind.is_outside}
    outside |= {actuator.name for actuator in study.mind.actuators if actuator.kind.is_outside}
    for noun, declarations in study.mind.names.table.items():
        known = {name: name.split("_") for name in kinds(noun) if name not in EVERYDAY}
        for name, declaration in declarations.items():
            said, phrase = name_words(name), declaration.header.phrase
            own = phrase.kind.text if phrase else ""
            other = next((kind for kind, parts in known.items() if said[-len(parts) :] == parts), own)
            if other != own and name not in outside and not {*known.get(own, ())} & {*said}:
                hint = f"Rename it: {study.main.edit('rename', name, 'NAME', '--noun', noun)}"
                span = declaration.header.name.span
                yield Finding(span, f"{name} sounds like {other}, but its kind is {own}.", hint)


ALIKE = str.maketrans("0O1I\u0430\u0435\u043e\u0440\u0441\u0445\u0443\u03bf", "oollaeopcxyo")


@rule()
def similar_names(study: Study) -> Found:
    """Names of one noun that look the same as one before them: those that others see come before the main file's."""
    seen: dict[tuple[str, str], Name] = {}
    for mention in introductions([*study.mind.files[1:], study.mind.files[0]]):
        name = mention.name
        firsts = [seen.setdefault((mention.noun, look), name) for look in _looks(name.text)]
        for first in [first for first in firsts if first.text != name.text][:1]:
            label = Label(first.span, f"{first.text} is declared here")
            hint = "Give one of the two another name: mindc edit rename."
            yield Finding(name.span, f"{name.text} looks almost like {first.text}.", hint, (label,))


def _looks(name: str) -> tuple[str, str]:
    """A name without case and without what only sets its words apart, and the same without look-alikes."""
    joined = re.sub(r"(?<!\d)_|_(?!\d)", "", name)
    return joined.casefold(), joined.translate(ALIKE).casefold()


OPPOSITE_SIDES = {"left": "right", "right": "left"}


@rule()
def wrong_side(study: Study) -> Found:
    for name, side, span in _sided(study):
        said = {*name_words(name)}
        if OPPOSITE_SIDES[side] in said and side not in said:
            hint = f"Put it on the {OPPOSITE_SIDES[side]}, or rename it: {study.main.edit('rename', name, 'NAME')}"
            yield Finding(span, f"{name} is on the {side}.", hint)


def _sided(study: Study) -> Iterator[tuple[str, str, Span]]:
    """The parts that are on a side, on which, and where they are declared."""
    for actuator in study.mind.actuators:
        if side := actuator.kind.mounted:
            yield actuator.name, side, actuator.span
    for sensor in study.mind.sensors:
        sides = {_side(angle) for angle in sensor.kind.directions}
        if len(sides) == 1 and (only := sides.pop()):
            yield sensor.name, only, sensor.span


def _side(angle: float) -> str:
    aside = sin(angle)
    return "" if abs(aside) < 1e-9 else "left" if aside > 0 else "right"
