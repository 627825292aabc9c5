"""Checkpoints: the state of a run in one file that knows whether it is whole, and the one before it.

Such a file is a line that names the format, a JSON header, the arrays' bytes in the header's order, and the SHA-256 of
all that. It is read only after that hash is right, so a truncated or altered file is never taken for a state.
"""

import json
from collections.abc import Mapping
from hashlib import sha256
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.files.atomic_write import sync_folder, write_beside
from mindrun.files.regular_files import read_whole
from mindrun.files.strict_json import is_whole, parsed
from mindrun.train import RunError
from mindrun.train.lesson_state import AttemptState, LessonState
from mindrun.train.population import Population, Scores

NAME, PREVIOUS = "checkpoint", "checkpoint.previous"
MAGIC = b"mind checkpoint 6\n"
DIGEST_BYTES = 32
MAX_CHECKPOINT_BYTES = 1 << 32
MAX_HEADER_BYTES = 1 << 24
MAX_COUNT = 2**53  # of any count
NUMBER_TYPES = ("<f4", "<f8", "<i8")

Arrays = dict[str, NDArray[Any]]
TYPES: dict[str, tuple[Any, ...]] = {  # of each array in the order of the file: its numbers, and how many on each side
    "genomes": ("<f4", "individuals", "weights"),
    "scores": ("<f8", "individuals"),
    "champion": ("<f4", "0 or 1", "weights"),
    "rival": ("<f4", "0 or one", "weights"),
    "rungs": ("<f8", "begun", "rungs"),
    "champions": ("<f4", "ended", "weights"),
    "lengths": ("<i8", "ended"),
    "verdicts": ("<f8", "ended", 2),
    "passed": ("<i8", "ended"),
    "floats": ("<f8", 2),
    "counts": ("<i8", 7),
}


def save(folder: Path, state: LessonState, run: str) -> None:
    """Write the state of the run named `run`; the checkpoint before it is kept if it is whole."""
    spare = write_beside(folder / NAME, pack(state, run))
    if _read(folder / NAME, run) is not None:
        (folder / NAME).replace(folder / PREVIOUS)
    spare.replace(folder / NAME)
    sync_folder(folder)


def load(folder: Path, run: str) -> tuple[LessonState, str] | None:
    """The newest whole checkpoint, and a warning where the newest of all is damaged; None where none was ever written.

    RunError where all are damaged.
    """
    newest, previous = folder / NAME, folder / PREVIOUS
    if (state := _read(newest, run)) is not None:
        return state, ""
    if (state := _read(previous, run)) is not None:
        damaged = f"{newest} is damaged: going on from the one before it" if newest.exists() else ""
        return state, damaged
    if newest.exists() or previous.exists():
        raise RunError(f"{newest} is damaged, and no other is left", "start the lesson again without --resume")
    return None


def pack(state: LessonState, run: str) -> bytes:
    now = state.now
    counts = state.attempt, now.population.generation, now.since, state.generations, state.ticks, state.faults
    arrays: Arrays = {
        "genomes": now.population.genomes,
        "scores": now.population.scores,
        "champion": now.champion,
        "rival": now.rival,
        "rungs": np.concatenate([state.rungs, now.climbed[None]]),
        "champions": state.champions,
        "lengths": state.lengths,
        "verdicts": state.verdicts,
        "passed": state.passed.astype(np.int64),
        "floats": np.array([state.best, state.seconds]),
        "counts": np.array([*counts, state.told_apart], np.int64),
    }
    return sealed(MAGIC, {"run": run}, arrays)


def unpack(data: bytes, run: str) -> LessonState | None:
    """The state in these bytes; None where they are damaged, of another run, or of no run at all."""
    arrays = unsealed(MAGIC, {"run": run}, data) or {}
    return _state(arrays) if [*arrays] == [*TYPES] and _are_consistent(arrays) else None


def sealed(magic: bytes, said: Mapping[str, object], arrays: Arrays) -> bytes:
    """Arrays as the bytes of a file of such a format, whose header says this beside their types and shapes."""
    shapes = {name: [array.dtype.str, list(array.shape)] for name, array in arrays.items()}
    header = json.dumps({**said, "arrays": shapes}).encode() + b"\n"
    body = magic + header + b"".join(np.ascontiguousarray(array).tobytes() for array in arrays.values())
    return body + sha256(body).digest()


def unsealed(magic: bytes, said: Mapping[str, object], data: bytes) -> Arrays | None:
    """The arrays in the bytes of a file whose header says this; None where they are damaged, or say something else."""
    body, digest = data[:-DIGEST_BYTES], data[-DIGEST_BYTES:]
    if not body.startswith(magic) or sha256(body).digest() != digest:
        return None
    header, _, rest = body[len(magic) :].partition(b"\n")
    try:
        meaning = parsed(header, MAX_HEADER_BYTES)
    except ValueError:
        return None
    shapes = meaning.pop("arrays", None) if isinstance(meaning, dict) else None
    if meaning != said or not isinstance(shapes, dict):
        return None
    arrays, start = dict[str, NDArray[Any]](), 0
    for name, shape in shapes.items():
        match shape:
            case [str(dtype), [*sides]] if dtype in NUMBER_TYPES and all(map(is_whole, sides)):
                size = prod(sides) * np.dtype(dtype).itemsize
            case _:
                return None
        if start + size > len(rest):
            return None
        arrays[name] = np.frombuffer(rest[start : start + size], dtype).reshape(sides).copy()
        start += size
    return arrays if start == len(rest) else None


def _are_consistent(arrays: Arrays) -> bool:
    """True if the arrays fit one another in shape, and their numbers are such as a run has."""
    sizes: dict[Any, int] = {2: 2, 7: 7}
    for (dtype, *sides), array in zip(TYPES.values(), arrays.values(), strict=True):
        if array.dtype.str != dtype or array.ndim != len(sides):
            return False
        if any(sizes.setdefault(side, length) != length for side, length in zip(sides, array.shape, strict=True)):
            return False
    if max(sizes["0 or 1"], sizes["0 or one"]) > 1 or sizes["begun"] != sizes["ended"] + 1:
        return False
    attempt, generation, *_, told_apart = arrays["counts"].tolist()
    return bool(
        all(np.isfinite(arrays[name]).all() for name in ("genomes", "champion", "rival", "champions"))
        and not any(np.isnan(arrays[name]).any() for name in ("scores", "rungs", "verdicts", "floats"))
        and all(((arrays[name] >= 0) & (arrays[name] <= MAX_COUNT)).all() for name in ("lengths", "counts"))
        and (attempt, generation > 0) == (sizes["ended"], sizes["individuals"] > 0)
        and told_apart <= 1
        and np.isin(arrays["passed"], (0, 1)).all()
    )


def _state(arrays: Arrays) -> LessonState:
    attempt, generation, since, generations, ticks, faults, told_apart = arrays["counts"].tolist()
    best, seconds = arrays["floats"].tolist()
    now = attempt_state(arrays, generation, since, arrays["rungs"][-1], told_apart)
    ended = arrays["rungs"][:-1], arrays["champions"], arrays["lengths"], arrays["verdicts"], arrays["passed"] == 1
    return LessonState(attempt, now, *ended, best, generations, ticks, seconds, faults, now.told_apart)


def attempt_state(arrays: Arrays, generation: int, since: int, climbed: Scores, told_apart: int) -> AttemptState:
    """The state of an attempt whose population, champion and rival are among arrays."""
    population = Population(arrays["genomes"], arrays["scores"], generation)
    return AttemptState(population, arrays["champion"], arrays["rival"], since, climbed, bool(told_apart))


def _read(path: Path, run: str) -> LessonState | None:
    try:
        return unpack(read_whole(path, MAX_CHECKPOINT_BYTES), run)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise RunError(f"cannot read {path}: {error.strerror}", "start the lesson again without --resume") from error
