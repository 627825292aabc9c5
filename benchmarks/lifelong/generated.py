"""Lessons for one robot, drawn with a seed: what is sought, chased, shunned, fetched or pushed, where, and for what.

A lesson of a hierarchy is two skills: Own1 drives, and Seek1 above it sends influence to it and to skills of earlier
lessons. In the text these are the last ones, so that all earlier ones stand below; the agent chooses others.
"""

from pathlib import Path

import numpy as np
from mindrun.kinds.learners import Genetic

from benchmarks.lifelong.sequence import Stage, TaskSequence
from benchmarks.workloads import graph_of
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

COLOURS = "red", "green", "blue"
NOMINAL_COUNTS = {"Seek": 6.0, "Chase": 8.0, "Shun": 15.0, "Fetch": 2.0, "Push": 2.0}  # in a run, of a skill that can
EVENT_POINTS, RUN_TICKS = 10, 1000
EARLIER_SKILLS = 3  # of earlier lessons, that a lesson's may influence
LOOKS_APART_LESSONS = 10  # after which all tasks are tried; in the last of so many some learn on the job


def hundred(seed: int, lessons: int = 100) -> TaskSequence:
    """So many lessons, drawn with a seed: the first lessons are the same, however many there are."""
    text, tasks = drawn(seed, lessons)
    return TaskSequence(
        graph_of(compile_source(Source("hundred.mind", text))),
        net="Net",
        tasks=tuple(tasks),
        good=tuple(EVENT_POINTS * NOMINAL_COUNTS[task.rstrip("0123456789")] for task in tasks),
        done=(1.0,) * lessons,
        stages=tuple((Stage(task, (task, f"Own{number}")),) for number, task in enumerate(tasks, 1)),
        ticks=8e6,
        earlier=EARLIER_SKILLS,
        looks_apart=LOOKS_APART_LESSONS,
        on_the_job=frozenset(range(LOOKS_APART_LESSONS - 1, lessons, LOOKS_APART_LESSONS)),
        learner=Genetic(octaves=2, short=0.3),
        is_shared_evenly=True,
        is_best_of_all=True,
    )


def drawn(seed: int, lessons: int) -> tuple[str, list[str]]:
    """The text of a mind with so many lessons, and the names of their tasks."""
    rng = np.random.default_rng(seed)
    lines, tasks = [Path(__file__).with_name("hundred.mind").read_text(encoding="utf-8")], list[str]()
    for number in range(1, lessons + 1):
        verb = str(rng.choice([*NOMINAL_COUNTS]))
        lines += _lesson(f"{verb}{number}", f"Own{number}", tasks[-EARLIER_SKILLS:], rng)
        tasks.append(f"{verb}{number}")
    return "\n".join(lines), tasks


def _lesson(name: str, own: str, earlier: list[str], rng: np.random.Generator) -> list[str]:
    """The lines of two skills and a task."""
    verb, (colour, other) = name.rstrip("0123456789"), rng.permutation(COLOURS)[:2].tolist()
    rocks = int(rng.choice([0, 0, 0, 3, 6]))
    reads = {f"{colour}_bearing": True, "near": rocks or verb == "Shun", "pulse": rocks}
    reads |= {f"{colour}_distance": verb in ("Shun", "Push"), "home_bearing": verb in ("Fetch", "Push")}
    reads |= {"holding": verb == "Fetch"}
    read = [f"  reads {sensor}" for sensor, is_read in reads.items() if is_read]
    return [
        *(f"\nskill {own} is mlp hidden 2", *read, "  drives left_wheel", "  drives right_wheel"),
        *(f"\nskill {name} is mlp hidden 1", *read, f"  influences {own}"),
        *(f"  influences {skill}" for skill in earlier),
        *(
            "  influences Grab at 1",
            f"\ntask {name} in arena size {rng.integers(30, 46)}",
            f"  lasts {RUN_TICKS} ticks",
        ),
        *_things(verb, colour, other, rng),
        *([f"  contains rock is obstacle count {rocks} size 2 to 3"] if rocks else []),
        *_robot(colour, rng),
        *_rewards(verb, colour, rng),
        *([str(rng.choice(["  ends on collision", "  rewards -1 on collision"]))] if rocks else []),
    ]


def _things(verb: str, colour: str, other: str, rng: np.random.Generator) -> list[str]:
    """The thing that a task is about, perhaps others that are of no use, and a home for what is brought there."""
    size, speed = rng.uniform(2, 5), rng.uniform(0.5, 2.5)
    kinds = {
        "Seek": [f"item size {size:.1f} reached moves", f"zone size {size + 2:.1f} reached moves"],
        "Chase": [f"walker size {size:.1f} speed {speed:.1f} reached moves"],
        "Shun": [f"walker count {rng.integers(2, 5)} size {size:.1f} speed {speed:.1f}"],
        "Fetch": ["item size 2"],
        "Push": ["box size 3", "ball size 3 damping 2"],
    }
    things = [f"  contains {colour} is {rng.choice(kinds[verb])}"]
    if rng.integers(2):
        things.append(f"  contains {other} is item count {rng.integers(1, 4)} size 2")
    if verb in ("Fetch", "Push"):
        things.append(f"  contains home is zone size {rng.integers(12, 17)}")
    return things


def _robot(colour: str, rng: np.random.Generator) -> list[str]:
    """The robot as it is in a task: with a weaker wheel, late commands, a noisy bearing, or as it was built."""
    weak, late, noise = rng.integers(70, 90), rng.integers(2, 7), rng.uniform(0.02, 0.08)
    wheel = rng.choice(["left_wheel", "right_wheel"])
    found: list[list[str]] = [
        [f"  varies thrust of {wheel} {weak} to {weak}"],
        [f"  varies delay of {each} {late} to {late} ticks" for each in ("left_wheel", "right_wheel")],
        [f"  varies noise of {colour}_bearing {noise:.3f} to {noise:.3f}"],
        [],
    ]
    return found[rng.integers(len(found))]


def _rewards(verb: str, colour: str, rng: np.random.Generator) -> list[str]:
    """The lines of what is paid and counted."""
    counted = {"Shun": "visit of patch size 4", "Fetch": f"delivery of {colour}", "Push": f"delivery of {colour}"}
    event, near = counted.get(verb, f"reach of {colour}"), rng.uniform(0.1, 0.2)
    found = [f"  rewards {EVENT_POINTS} on {event}", f"  counts {event}"]
    if rng.integers(2):
        found.append(f"  rewards {rng.uniform(0.001, 0.004):.3f} * forward per tick")
    if verb == "Shun":
        return [*found, f"  ends on reach of {colour}"]
    if verb != "Fetch":
        return [*found, f"  rewards {near:.2f} * progress toward {colour} per tick"]
    ways = (colour, "holding < 0.5"), ("home", "holding > 0.5")
    return [*found, *(f"  rewards {near:.2f} * progress toward {to} per tick when {when}" for to, when in ways)]
