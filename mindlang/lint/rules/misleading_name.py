"""A name that ends with the name of another kind than its own.

The last word of a name is what people take the thing for. `ball_bearing is derivative of ...` reads like a bearing
wherever it is used: call it `ball_drift`. Of an environment's observations and actions only a name says what they are.
"""

from mindrun.kinds.registry import kinds

from mindlang.lint.study import Finding, Found, Study, name_words

EVERYDAY = {
    "arena", "battery", "cell", "contact", "disc", "genetic", "held", "inside", "item", "mirrored", "plain", "rule",
    "turned", "zone",
}  # fmt: skip
GOOD = """
sensor charge is battery
sensor battery_drift is derivative of charge
skill Go is rule
  reads battery_drift
  drives left_wheel at battery_drift
"""
BAD = GOOD.replace("battery_drift", "battery_bearing")


def check(study: Study) -> Found:
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
