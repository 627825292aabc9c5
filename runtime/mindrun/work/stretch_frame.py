"""A stretch of an attempt as a frame, and the segment that answers it; what no attempt comes to is refused."""

from collections.abc import Mapping
from dataclasses import astuple
from math import isnan, nan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import BundleError
from mindrun.files.strict_json import is_whole
from mindrun.graph.codec import encode
from mindrun.graph.encoding import decode_part
from mindrun.graph.graph import Lesson
from mindrun.graph.validate import lesson_flaws
from mindrun.train.ask_and_tell import kept_count
from mindrun.train.attempt import Verdict
from mindrun.train.lesson_state import AttemptState, Course, Record
from mindrun.train.manifest import MAX_SEED
from mindrun.train.population import Population
from mindrun.train.segment import SEGMENT_GENERATIONS, Segment, Stretch
from mindrun.work.frame import Arrays, Frame, FrameError

ADVANCE, SEGMENT = "advance", "segment"
RECORD_NUMBERS = 9  # of a record, in the order of its fields; NaN for None
MAX_COUNT = 2**53

STATE = {  # the arrays of an attempt's state: their numbers, and how many dimensions each has
    "genomes": ("<f4", 2),
    "scores": ("<f8", 1),
    "champion": ("<f4", 2),
    "rival": ("<f4", 2),
    "climbed": ("<f8", 1),
}
START, OF_SEGMENT = {"start": ("<f4", 2)}, {"champions": ("<f4", 2), "records": ("<f8", 2), "verdict": ("<f8", 2)}


def stretch_frame(course: Course, stretch: Stretch, about: Mapping[str, Any]) -> Frame:
    """A stretch as a frame; `about` is what else a job says."""
    said = {"lesson": encode(course.lesson), "seed": course.seed, "cut": stretch.cut}
    return Frame(
        ADVANCE,
        {**about, **said, **_about(stretch.number, stretch.state)},
        _state(stretch.state) | {"start": course.start},
    )


def stretch_of(frame: Frame) -> tuple[Course, Stretch]:
    """The course and the stretch that a frame is; FrameError where it is none."""
    about, arrays = frame.about, frame.arrays
    _refuse_others(arrays, STATE | START)
    try:
        lesson = decode_part(Lesson, about.get("lesson"), "lesson")
    except BundleError as error:
        raise FrameError(f"its lesson is none: {error}") from error
    flaw = next(iter(lesson_flaws(lesson)), "")
    if flaw or not is_whole(about.get("seed"), 0, MAX_SEED) or not isinstance(about.get("cut"), bool):
        raise FrameError(f"it is no stretch of a lesson {flaw}")
    if len(arrays["start"]) > 1 or not np.isfinite(arrays["start"]).all():
        raise FrameError("what its skill knows is no genome")
    course = Course(lesson, about["seed"], arrays["start"])
    number, state = _read_state(course, frame)
    return course, Stretch(number, state, about["cut"])


def segment_frame(number: int, segment: Segment) -> Frame:
    """A segment as a frame."""
    rows = [[nan if value is None else float(value) for value in astuple(record)] for record in segment.records]
    verdict = segment.verdict
    ends = [] if verdict is None else [[*verdict.scores, verdict.passed, verdict.ticks, verdict.faults]]
    more: dict[str, NDArray[Any]] = {
        "champions": segment.champions,
        "records": np.array(rows, np.float64).reshape(-1, RECORD_NUMBERS),
        "verdict": np.array(ends, np.float64).reshape(-1, 5),
    }
    return Frame(SEGMENT, _about(number, segment.state), _state(segment.state) | more)


def segment_of(frame: Frame, course: Course, stretch: Stretch, most: int = SEGMENT_GENERATIONS) -> Segment:
    """The segment of `most` generations that a frame is; FrameError where it cannot be what came of the stretch."""
    _refuse_others(frame.arrays, STATE | OF_SEGMENT)
    number, state = _read_state(course, frame)
    champions, rows, ends = (frame.arrays[name] for name in OF_SEGMENT)
    before = stretch.state.population.generation
    if (
        number != stretch.number
        or len(rows) != state.population.generation - before
        or len(rows) > most
        or (len(rows) == 0) != stretch.cut
        or champions.shape != (len(rows), course.start.shape[1])
        or not np.isfinite(champions).all()
        or rows.shape[1] != RECORD_NUMBERS
        or ends.shape not in ((0, 5), (1, 5))
        or np.isnan(ends).any()
    ):
        raise FrameError("it is not what was asked for")
    records = tuple(_record(row, number, before + place) for place, row in enumerate(rows.tolist(), 1))
    if not len(ends):
        return Segment(state, records, champions, None)
    passed, ticks, faults = (_count(value) for value in ends[0, 2:].tolist())
    return Segment(state, records, champions, Verdict(ends[0, :2].copy(), bool(passed), ticks, faults))


def _about(number: int, state: AttemptState) -> dict[str, Any]:
    generation = state.population.generation
    return {"number": number, "generation": generation, "since": state.since, "told_apart": bool(state.told_apart)}


def _state(state: AttemptState) -> dict[str, NDArray[Any]]:
    population = state.population
    return {
        "genomes": population.genomes,
        "scores": population.scores,
        "champion": state.champion,
        "rival": state.rival,
        "climbed": state.climbed,
    }


def _read_state(course: Course, frame: Frame) -> tuple[int, AttemptState]:
    """The number and the state of an attempt; FrameError where no attempt of the course stands so."""
    match frame.about:
        case {"number": int(number), "generation": int(generation), "since": int(since), "told_apart": bool(told)}:
            genomes, scores, champion, rival, climbed = (frame.arrays[name] for name in STATE)
        case _:
            raise FrameError("it does not say where an attempt stands")
    lesson, weights = course.lesson, course.start.shape[1]
    if not (
        0 <= number < lesson.learner.attempts
        and 0 <= since <= generation <= lesson.generations
        and len(genomes) == len(scores) == (kept_count(lesson.learner) if generation else 0)
        and max(len(champion), len(rival)) <= 1
        and climbed.shape == (lesson.learner.rungs,)
        and all(each.shape[1] == weights and np.isfinite(each).all() for each in (genomes, champion, rival))
        and not (np.isnan(scores).any() or np.isnan(climbed).any())
        and not (generation and not len(champion))
    ):
        raise FrameError("no attempt of its lesson stands so")
    return number, AttemptState(Population(genomes, scores, generation), champion, rival, since, climbed, told)


def _record(row: list[float], number: int, generation: int) -> Record:
    """The record that these numbers are."""
    attempt, place, best, mean, reevaluated, verdict, ticks, seconds, faults = row
    scores = best, mean, *(value for value in (reevaluated, verdict) if not isnan(value))
    if (attempt, place) != (number + 1, generation) or any(map(isnan, (*scores, seconds))) or not seconds >= 0:
        raise FrameError("its records are not those of its generations")
    tried, judged = (None if isnan(value) else value for value in (reevaluated, verdict))
    return Record(number + 1, generation, best, mean, tried, judged, _count(ticks), seconds, _count(faults))


def _count(value: float) -> int:
    if not 0 <= value <= MAX_COUNT or value != int(value):
        raise FrameError("it counts what cannot be counted")
    return int(value)


def _refuse_others(arrays: Arrays, expected: Mapping[str, tuple[str, int]]) -> None:
    found = {name: (array.dtype.str, array.ndim) for name, array in arrays.items()}
    if found != dict(expected):
        raise FrameError("its arrays are of other names, numbers or dimensions")
