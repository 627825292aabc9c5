"""The text of a robot.yaml for a mind: a usual driver for each sensor and actuator, and room for what only you know."""

import re
from collections.abc import Iterator, Mapping

from mindrun.graph.graph import Actuator, Graph, Sensor
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import read_by
from mindrun.kinds.registry import names

from mindlang.robot.driver import example
from mindlang.robot.options import driver_options, drivers
from mindlang.templates.project import wiring_file

# The driver that a kind usually has, and what is said of it there; any other may be written instead.
SENSORS = {
    "range_finder": ("ultrasonic",),
    "eye": ("ball_eye",),
    "bearing": ("ball_tracker",),
    "distance": ("ball_tracker", "measure: distance"),
    "bumper": ("bumper",),
    "contact": ("bumper",),
    "light": ("mcp3008",),
    "floor": ("line_sensor",),
    "battery": ("ads1115",),
    "compass": ("lsm9ds1_compass",),
    "inertial": ("lsm9ds1_motion",),
    "turn_rate": ("mpu6050",),
    "odometer": ("encoder",),
    "speed": ("encoder",),
    "held": ("switch",),
}
ACTUATORS = {
    **dict.fromkeys(("wheel", "thruster", "motor"), ("h_bridge",)),
    **dict.fromkeys(("steering", "servo", "gripper"), ("servo",)),
    "lamp": ("lamp",),
}


def robot_yaml(graph: Graph, name: str) -> tuple[str, int]:
    """The text for a mind called so, and how many values are to be filled in: what has none is a mistake of `build`."""
    read = read_by(graph, graph.master)
    sensors = [part for each, part in physical(graph).items() if each in read]
    wired = [_lines("sensor", SENSORS, each, each.width) for each in sensors if each.kind.needs_driver]
    parts = ["".join(f"  {line}\n" for line in lines) for lines in wired]
    for each in (each for each in sensors if each.kind.tells_servo):
        said = f"is reckoned from what {each.kind.servo} is sent; a driver here would measure it"
        parts.append(f"  # {each.name} {said}\n")
    driven = (_lines("actuator", ACTUATORS, each, 1) for each in graph.actuators)
    moved = ["".join(f"  {line}\n" for line in lines) for lines in driven]
    text = wiring_file(re.sub(r"[^\w .-]", "_", name), "\n".join(parts), "\n".join(moved))
    return text, sum(line.split("#")[0].rstrip().endswith(":") and "#" in line for line in text.splitlines())


def _lines(noun: str, usual: Mapping[str, tuple[str, ...]], part: Sensor | Actuator, width: int) -> Iterator[str]:
    kind = names()[type(part.kind)]
    yield f"# {kind}" + (f", {width} readings" if width > 1 else "")
    yield f"{part.name}:"
    if kind not in usual:
        yield f"  driver:  # your own, FILE.CLASS or PACKAGE.NAME, or one of {', '.join(sorted(drivers(noun)))}"
        return
    driver, *said = usual[kind]
    yield f"  driver: {driver}"
    yield from (f"  {each}" for each in said)
    for option in driver_options(drivers(noun)[driver]):
        if option.required:
            of = f"{width} of them: " if option.shape.endswith("s") else ""
            yield f"  {option.key}:  # {of}{example(option)}"
