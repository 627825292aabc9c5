"""A hundred lessons for one robot, drawn with a seed: what is sought, chased, shunned, fetched or pushed, and where."""

import numpy as np

from benchmarks.lifelong.sequence import TaskSequence
from benchmarks.lifelong.written import EVENT_POINTS, WrittenLesson, sequence_of

ROBOT = "hundred.mind"
COLOURS = "red", "green", "blue"
NOMINAL_COUNTS = {"Seek": 6.0, "Chase": 8.0, "Shun": 15.0, "Fetch": 2.0, "Push": 2.0}  # in a run, of a skill that can
RUN_TICKS = 1000
LOOKS_APART_LESSONS = 10  # after which all tasks are tried; in the last of so many some learn on the job


def hundred(seed: int) -> TaskSequence:
    """The hundred lessons of a seed."""
    lessons, apart = drawn(seed, 100), LOOKS_APART_LESSONS
    on_the_job = frozenset(range(apart - 1, len(lessons), apart))
    return sequence_of(ROBOT, lessons, NOMINAL_COUNTS, ticks=8e6, looks_apart=apart, on_the_job=on_the_job)


def drawn(seed: int, lessons: int) -> list[WrittenLesson]:
    """Lessons that are drawn with a seed, one after the other: the first are the same, however many there are."""
    rng = np.random.default_rng(seed)
    return [_lesson(str(rng.choice([*NOMINAL_COUNTS])), number, rng) for number in range(1, lessons + 1)]


def _lesson(verb: str, number: int, rng: np.random.Generator) -> WrittenLesson:
    """A lesson of a verb: the more there is to see in its world, the more its skills read."""
    colour, other = rng.permutation(COLOURS)[:2].tolist()
    rocks = int(rng.choice([0, 0, 0, 3, 6]))
    reads = {f"{colour}_bearing": True, "near": rocks or verb == "Shun", "pulse": rocks}
    reads |= {f"{colour}_distance": verb in ("Shun", "Push"), "home_bearing": verb in ("Fetch", "Push")}
    reads |= {"holding": verb == "Fetch"}
    task = [
        *(f"in arena size {rng.integers(30, 46)}", f"  lasts {RUN_TICKS} ticks"),
        *_things(verb, colour, other, rng),
        *([f"  contains rock is obstacle count {rocks} size 2 to 3"] if rocks else []),
        *_robot(colour, rng),
        *_rewards(verb, colour, rng),
        *([str(rng.choice(["  ends on collision", "  rewards -1 on collision"]))] if rocks else []),
    ]
    return WrittenLesson(f"{verb}{number}", [sensor for sensor, is_read in reads.items() if is_read], task)


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
