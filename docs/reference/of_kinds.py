"""Which kind has which picture."""

from collections.abc import Callable, Mapping
from functools import partial
from math import pi
from typing import Any

from mindrun.kinds.registry import kinds

from docs.reference import around, bodies, marks, svg
from docs.reference.over_time import over_time
from mindlang.explaining.article import Article

ROCK_PLACES = ((6.0, 5.6, 2.2), (0.4, -7.0, 2.0))
GEM_PLACES = ((8.0, 4.0, 2.2), (2.5, -7.0, 2.0))
Draw = Callable[[Article], str]


def _angles(*degrees: float) -> tuple[float, ...]:
    return tuple(each * pi / 180 for each in degrees)


def _titled(draw: Callable[..., str], *arguments: Any) -> Draw:
    """A picture whose title is what the kind is."""
    return lambda article: draw(f"{article.name}: {article.summary}", *arguments)


def _marked(drawn: marks.Drawn) -> Draw:
    return partial(marks.marks, drawn=drawn)


def _computed(name: str, **arguments: Any) -> Draw:
    """A sensor with these arguments over some seconds."""
    return _titled(over_time, kinds("sensor")[name](**arguments))


def _measured(draw: Callable[..., str], name: str, *said: str) -> Draw:
    """A body with the sizes that it has where nothing is said."""
    body = kinds("body")[name]()
    return _titled(draw, *(getattr(body, each) for each in said))


OF_KINDS: Mapping[tuple[str, str], Draw] = {
    ("body", "disc"): _measured(bodies.disc, "disc", "size"),
    ("body", "box"): _measured(bodies.box, "box", "size"),
    ("body", "car"): _measured(bodies.car, "car", "size", "wheelbase"),
    ("body", "holonomic"): _measured(bodies.holonomic, "holonomic", "size"),
    ("actuator", "lamp"): _marked(marks.lit),
    ("actuator", "servo"): _marked(marks.swung),
    ("actuator", "wheel"): _marked(marks.wheel),
    ("actuator", "motor"): _marked(marks.driven),
    ("actuator", "steering"): _marked(marks.steered),
    ("actuator", "thruster"): _marked(marks.thrust),
    ("actuator", "gripper"): _marked(marks.gripped),
    ("sensor", "speed"): _marked(marks.pushed),
    ("sensor", "odometer"): _marked(marks.wheel),
    ("sensor", "turn_rate"): _marked(marks.turned),
    ("sensor", "distance"): _marked(marks.away),
    ("sensor", "range_finder"): _titled(around.rays, _angles(-90, -45, 0, 45, 90), 12.0, ROCK_PLACES, svg.ROCK),
    ("sensor", "eye"): _titled(around.rays, _angles(-60, -30, 0, 30, 60), 12.0, GEM_PLACES, svg.ORANGE),
    ("sensor", "bearing"): _titled(around.dial, "what it reads of a thing there"),
    ("sensor", "compass"): _titled(around.dial, "what it reads with north there"),
    ("sensor", "direction"): _titled(around.dial, "what it reads of a servo that looks there"),
    ("sensor", "bumper"): _titled(around.sectors, _angles(-45, 0, 45), *_angles(45), 2),
    ("sensor", "floor"): _titled(around.spots, (0.5, 0.0, -0.5), 2.0),
    ("sensor", "average"): _computed("average", of="moving", over=30),
    ("sensor", "derivative"): _computed("derivative", of="moving", range=3.0),
    ("sensor", "latch"): _computed("latch", of="moving", below=0.2, above=0.8),
    ("sensor", "sine"): _computed("sine", period=2.0),
    ("sensor", "clock"): _computed("clock", period=4.0),
}
