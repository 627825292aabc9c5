"""Minds in environments, both drawn: spaces of every kind, and whatever a text can say of them."""

from dataclasses import dataclass
from functools import cache
from random import Random
from typing import Any

import numpy as np

FOLDER_OF_WORLDS = "drawn"
WORLDS = 40  # of which one is drawn
OBSERVED_PARTS = ("near", "far.seen", "Hand", "pair")  # of a Dict; the last is a tuple
MINDS = ("mlp hidden 1", "mlp hidden 1 width 3", "elman width 3", "rule")


def world_name(number: int) -> str:
    """What a drawn environment is called."""
    return f"{FOLDER_OF_WORLDS}/World{number}-v0"


@dataclass(frozen=True)
class Leaf:
    """An array of a space: `counts` where it is of choices, from `start` on, else `ends`, which may be infinite."""

    shape: tuple[int, ...]
    counts: tuple[int, ...] = ()
    start: int = 0
    ends: tuple[float, float] = (0.0, 0.0)
    kind: str = "Box"
    dtype: str = "float32"

    def places(self) -> list[tuple[int, ...]]:
        """Every index in it."""
        return [tuple(map(int, index)) for index in np.ndindex(self.shape or (1,))]


Tree = Leaf | dict[str, Any] | tuple[Any, ...]


def observed_tree(rng: Random) -> Tree:
    """What an environment observes: a leaf, or parts by their names, tuples and parts in parts among them."""
    if rng.random() < 0.4:
        return _leaf(rng)
    if rng.random() < 0.3:
        return tuple(_leaf(rng) for _ in range(rng.randint(1, 3)))
    return {"near": _leaf(rng), "far": {"seen": _leaf(rng)}, "Hand": _leaf(rng), "pair": (_leaf(rng), _leaf(rng))}


def acted_tree(rng: Random) -> Tree:
    """What it takes; of several parts one has no numbers."""
    if rng.random() < 0.6:
        return _leaf(rng, small=True)
    if rng.random() < 0.4:
        return tuple(_leaf(rng, small=True) for _ in range(rng.randint(1, 2)))
    return {"go": _leaf(rng, small=True), "arm": {"Grip": _leaf(rng, small=True), "none": Leaf((0,), ends=(-1.0, 1.0))}}


def _leaf(rng: Random, small: bool = False) -> Leaf:
    match rng.choice(["box", "box", "infinite", "whole", "discrete", "several", "binary", "image"]):
        case "discrete":
            count, start = rng.randint(1, 4), rng.choice([0, 0, 2])
            return Leaf((), (count,), start, kind="Discrete", dtype="int64")
        case "several":
            counts = tuple(rng.randint(1, 3) for _ in range(rng.randint(1, 3)))
            return Leaf((len(counts),), counts, kind="MultiDiscrete", dtype="int64")
        case "binary":
            shape = rng.choice([(2,), (2, 2)])
            return Leaf(shape, (2,) * int(np.prod(shape)), kind="MultiBinary", dtype="int8")
        case "image" if not small:
            return Leaf((3, 2, 3), ends=(0.0, 255.0), dtype="uint8")
        case "infinite":
            return Leaf(rng.choice([(2,), (1, 2)]), ends=(-np.inf, np.inf), dtype=rng.choice(["float32", "float64"]))
        case "whole":
            return Leaf((2,), ends=(-5.0, 5.0), dtype="int64")
    shape = rng.choice([(), (1,), (2,), (2, 2)])
    return Leaf(shape, ends=(-1.0, rng.choice([1.0, 2.5])), dtype=rng.choice(["float32", "float64"]))


def leaves(tree: Tree, path: tuple[Any, ...] = ()) -> list[tuple[tuple[Any, ...], Leaf]]:
    """The leaves of a tree, and the keys that lead to each."""
    if isinstance(tree, Leaf):
        return [(path, tree)]
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    return [found for key, inner in items for found in leaves(inner, (*path, key))]


@cache
def trees(number: int) -> tuple[Tree, Tree]:
    """What the drawn environment of that number observes and takes."""
    rng = Random(number)
    return observed_tree(rng), acted_tree(rng)


def environment_mind(rng: Random, module: str = "") -> str:
    """The text of a mind in a drawn environment, which compiles; with a module before its name nobody asks that."""
    number = rng.randrange(WORLDS)
    observed, acted = trees(number)
    sensors = _sensors(rng, observed)
    actuators = _actuators(rng, acted)
    readable = [*sensors, *(["quick"] if rng.random() < 0.5 else []), *(["past"] if rng.random() < 0.5 else [])]
    lines = ["tick 1/50 s", "master Go", *sensors.values(), *actuators.values()]
    if "quick" in readable:
        source = rng.choice([*sensors])
        lines.append(
            rng.choice([f"sensor quick is derivative of {source}", f"sensor quick is computed at 1 - {source}"])
        )
    if "past" in readable:
        lines.append("memory past is cell decay 0.9")
    if view := _view(rng, observed):
        lines += view
        readable += ["glance"]
    lines += _skills(rng, readable, [*actuators])
    return "\n".join([*lines, *_task(rng, module + world_name(number), [*sensors], [*actuators]), ""])


def _sensors(rng: Random, observed: Tree) -> dict[str, str]:
    slots = [(path, leaf, index) for path, leaf in leaves(observed) for index in leaf.places()]
    chosen = rng.sample(slots, min(len(slots), rng.randint(1, 5)))
    found = {}
    for number, (path, leaf, index) in enumerate(chosen):
        low, high = rng.choice([("-1", "1"), ("-0.5", "2"), ("0", "0.25"), ("0", "255")])
        more = "".join(
            word for word in (" noise 3%", " lost 5%", " every 3 ticks", " delay 2 ticks") if rng.random() < 0.15
        )
        words = _words(path, index if leaf.shape or not _numbered(path) or rng.random() < 0.5 else ())
        found[f"seen{number}"] = f"sensor seen{number} is observation {words} range {low} to {high}{more}"
    return found


def _view(rng: Random, observed: Tree) -> list[str]:
    """Several numbers as one sensor, and the last of them as another; none where no leaf has several."""
    wide = [(path, len(leaf.places())) for path, leaf in leaves(observed) if len(leaf.places()) > 1]
    if not wide or rng.random() < 0.5:
        return []
    path, count = rng.choice(wide)
    first = rng.randrange(count - 1)
    last = rng.randrange(first + 1, count)
    more = rng.choice(["", "", " noise 3%", " lost 5% every 2 ticks", " delay 2 ticks"])
    view = f"sensor view is observations {_words(path, (first,))} to {last} range -0.5 to {rng.choice([2, 255])}{more}"
    return [view, f"sensor glance is reading {last - first + 1} of view"]


def _numbered(path: tuple[Any, ...]) -> bool:
    return bool(path) and isinstance(path[-1], int)


def _words(path: tuple[Any, ...], index: tuple[int, ...]) -> str:
    """A place as it is written: a part by its name, a tuple's by its number, then the index."""
    names, numbers = [key for key in path if isinstance(key, str)], [key for key in path if isinstance(key, int)]
    return " ".join([*([".".join(names)] if names else []), *map(str, (*numbers, *index))])


def _actuators(rng: Random, acted: Tree) -> dict[str, str]:
    found = {}
    for path, leaf in leaves(acted):
        for place, index in enumerate(leaf.places()):
            if not leaf.counts:
                name = f"do{len(found)}"
                said = " range -0.75 to 1" if np.isinf(leaf.ends[1]) or rng.random() < 0.2 else ""
                found[name] = f"actuator {name} is action {_words(path, index)}{_rest(rng)}{said}"
                continue
            shown = index if leaf.shape else ()
            for choice in rng.sample(range(leaf.counts[place]), rng.randint(1, leaf.counts[place])):
                name = f"do{len(found)}"
                words = _words(path, (*shown, choice + leaf.start))
                found[name] = f"actuator {name} is choice {words}{_rest(rng)}"
    return found


def _rest(rng: Random) -> str:
    return f" neutral {rng.choice(['0', '0.5', '30%'])}" + (" delay 2 ticks" if rng.random() < 0.2 else "")


def _skills(rng: Random, readable: list[str], actuators: list[str]) -> list[str]:
    kind = rng.choice(MINDS)
    lines = [f"skill Go is {rng.choice(MINDS[:2])}", *(f"  reads {name}" for name in readable), "  influences Low"]
    lines += ["  influences High cuts below 5%" if rng.random() < 0.3 else "  influences High"]
    lines += [f"skill Low is {kind}", *(f"  reads {name}" for name in readable)]
    for name in actuators:
        lines.append(f"  drives {name}" + (f" at {readable[0]} * 0.8" if kind == "rule" else ""))
    if "past" in readable:
        lines.append("  drives past" + (" at 0.7" if kind == "rule" else ""))
    lines += ["skill High is rule", *(f"  drives {name} at {rng.choice(['1', '0.2', '0.55'])}" for name in actuators)]
    return lines


def _task(rng: Random, world: str, sensors: list[str], actuators: list[str]) -> list[str]:
    one, other = rng.choice(sensors), rng.choice(actuators)
    lines = [f"task Go in gymnasium {world}", f"  lasts {rng.randint(1, 30)} ticks"]
    rewards = [
        "its reward", f"its reward when {one} > 0.3", "0.1 * its reward per tick", f"its reward - {one} per tick",
        f"{other} * its reward per tick", "10 on its end", f"{one} on its end when {one} < 0.8", "7 on success",
        "3 per tick", f"greatest of its reward (-0.1) {one} per tick", f"{one} - least of 0.2 its reward per tick",
    ]  # fmt: skip
    chosen = rng.sample(rewards, rng.randint(1, 4))
    if rng.random() < 0.3:
        lines.append(f"  fails {other} 5% per tick")
    if rng.random() < 0.3:
        lines.append(f"  varies delay of {other} 0 ticks to 3 ticks")
    end = rng.choice(["", "  ends on its end", "  ends on 2 its end", f"  ends when {one} > 0.97"])
    succeeds = "7 on success" in chosen or rng.random() < 0.2
    lines += [end] if end else []
    lines += [rng.choice(["  succeeds on its end", f"  succeeds when {one} > 0.9"])] if succeeds else []
    lines += ["  counts its end"] if rng.random() < 0.3 else []
    lines += ["  counts success within 3 ticks of its end"] if succeeds and rng.random() < 0.5 else []
    return [*lines, *(f"  rewards {line}" for line in chosen)]
