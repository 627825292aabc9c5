"""Checkpoints: the state of a run in one file that knows whether it is whole, and the one before it.

The file is a line that names the format, a JSON header, the arrays' bytes in the header's order, and the SHA-256 of all
that. It is read only after that hash is right, so a truncated or altered file is never taken for a state.
"""

import json
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.durable import sync_folder, write_beside
from mindrun.train.errors import RunError
from mindrun.train.genetic import Population
from mindrun.train.lesson import State

NAME, PREVIOUS = "checkpoint", "checkpoint.previous"
MAGIC = b"mind checkpoint 4\n"
DIGEST = 32


@dataclass(frozen=True, slots=True)
class Found:
    """A state read back; `warning` says so where the newest checkpoint was damaged and the one before it was taken."""

    state: State
    warning: str = ""


def save(folder: Path, state: State, run: str) -> None:
    """Write the state of the run named `run`; the checkpoint before it is kept if it is whole."""
    spare = write_beside(folder / NAME, pack(state, run))
    if _read(folder / NAME, run) is not None:
        (folder / NAME).replace(folder / PREVIOUS)
    spare.replace(folder / NAME)
    sync_folder(folder)


def load(folder: Path, run: str) -> Found | None:
    """The newest whole checkpoint, None where none was ever written; RunError where all are damaged."""
    newest, previous = folder / NAME, folder / PREVIOUS
    if (state := _read(newest, run)) is not None:
        return Found(state)
    if (state := _read(previous, run)) is not None:
        damaged = f"{newest} is damaged: going on from the one before it" if newest.exists() else ""
        return Found(state, damaged)
    if newest.exists() or previous.exists():
        raise RunError(f"{newest} is damaged, and no other is left", "start the lesson again without --resume")
    return None


def pack(state: State, run: str) -> bytes:
    """A state as bytes."""
    arrays: dict[str, NDArray[Any]] = {
        "genomes": state.population.genomes,
        "scores": state.population.scores,
        "champion": state.champion,
        "rival": state.rival,
        "champions": state.champions,
        "lengths": state.lengths,
        "verdicts": state.verdicts,
        "floats": np.array([state.best, state.seconds]),
        "counts": np.array(_counts(state), np.int64),
    }
    shapes = {name: [array.dtype.str, list(array.shape)] for name, array in arrays.items()}
    header = json.dumps({"run": run, "arrays": shapes}).encode() + b"\n"
    body = MAGIC + header + b"".join(np.ascontiguousarray(array).tobytes() for array in arrays.values())
    return body + sha256(body).digest()


def _counts(state: State) -> tuple[int, ...]:
    """Its whole numbers, in the order of the file."""
    generation = state.population.generation
    return state.attempt, generation, state.since, state.generations, state.ticks, state.faults, state.told_apart


def unpack(data: bytes, run: str) -> State | None:
    """The state in these bytes; None where they are damaged or of another run."""
    body, digest = data[:-DIGEST], data[-DIGEST:]
    if not body.startswith(MAGIC) or sha256(body).digest() != digest:
        return None
    header, _, rest = body[len(MAGIC) :].partition(b"\n")
    meaning = json.loads(header)
    if meaning["run"] != run:
        return None
    return _state(_arrays(meaning["arrays"], rest))


def _arrays(shapes: dict[str, tuple[str, list[int]]], data: bytes) -> dict[str, NDArray[Any]]:
    arrays, start = {}, 0
    for name, (dtype, shape) in shapes.items():
        count = int(np.prod(shape))
        arrays[name] = np.frombuffer(data, np.dtype(dtype), count, start).reshape(shape).copy()
        start += arrays[name].nbytes
    return arrays


def _state(arrays: dict[str, NDArray[Any]]) -> State:
    attempt, generation, since, generations, ticks, faults, told_apart = (int(count) for count in arrays["counts"])
    best, seconds = (float(number) for number in arrays["floats"])
    population = Population(arrays["genomes"], arrays["scores"], generation)
    now = arrays["champion"], arrays["rival"], since
    ended = arrays["champions"], arrays["lengths"], arrays["verdicts"]
    return State(attempt, population, *now, *ended, best, generations, ticks, seconds, faults, bool(told_apart))


def _read(path: Path, run: str) -> State | None:
    try:
        return unpack(path.read_bytes(), run)
    except FileNotFoundError:
        return None
