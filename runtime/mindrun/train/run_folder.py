"""A run's folder, `runs/<lesson>/<utc>-<seed>/`: made once, never overwritten, enough by itself to go on."""

import fcntl
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from stat import S_ISREG
from typing import Any

import numpy as np

from mindrun.errors import system_errors_as
from mindrun.files import atomic_write
from mindrun.files.archive import read_archive, write_archive
from mindrun.files.npy import from_npy, to_npy
from mindrun.files.regular_files import irregular, read_regular, read_whole
from mindrun.files.strict_json import parsed
from mindrun.graph.weights import Weights
from mindrun.train import NotFoundError, RunError, checkpoint
from mindrun.train.lesson_state import Course
from mindrun.train.manifest import Manifest, from_json, hashes, to_json
from mindrun.train.population import Genomes

MANIFEST, SOURCES, START, WEIGHTS = "manifest.json", "source", "start.npz", "weights.npy"
CHAMPIONS, RESULT, FAILURE = "champions.npy", "result.json", "failed.txt"
MAX_PID_DIGITS = 20  # of the number of a process
MAX_FILE_BYTES = 1 << 27  # of a manifest, a result, or the weights of all skills


@dataclass(frozen=True, slots=True)
class RunFolder:
    """A run on the disk; `weights` are those of all its skills as it began."""

    folder: Path
    manifest: Manifest
    weights: Mapping[str, Weights]

    @property
    def begins_with_nothing(self) -> bool:
        learners = self.manifest.learners
        return self.manifest.lesson.from_scratch or any(skill not in self.weights for skill in learners)

    def course(self, genome_length: int) -> Course:
        """The course of the run, which begins from the learners' weights unless they have none or start from scratch.

        RunError where these are not the weights of such a genome.
        """
        lesson = self.manifest.lesson
        if self.begins_with_nothing:
            return Course(lesson, self.manifest.seed, np.empty((0, genome_length), np.float32))
        known = (self.weights[skill] for skill in self.manifest.learners)
        start = np.concatenate([*known, np.zeros(0, np.float32)])[None]
        if start.shape[1] != genome_length:
            raise _damaged(self.folder / START)
        return Course(lesson, self.manifest.seed, start)


def create(runs: Path, manifest: Manifest, sources: Mapping[str, str], weights: Mapping[str, Weights]) -> RunFolder:
    """A new run folder under `runs`, with the text of each source by its path; RunError where it cannot be written."""
    stamp = "".join(letter for letter in manifest.started if letter not in "-:")
    with system_errors_as(RunError, f"cannot write a run under {runs}", "choose another folder with --runs"):
        folder = _unused(runs / manifest.name, f"{stamp}-{manifest.seed}")
        for path, text in sources.items():
            (folder / SOURCES / path).parent.mkdir(parents=True, exist_ok=True)
            atomic_write.write(folder / SOURCES / path, text.encode())
        packed = write_archive((f"{skill}.npy", to_npy(array)) for skill, array in sorted(weights.items()))
        atomic_write.write(folder / START, packed)
        atomic_write.write(folder / MANIFEST, to_json(manifest))  # last: with it the folder is a run
    return RunFolder(folder, manifest, dict(weights))


def unfinished(runs: Path, manifest: Manifest) -> RunFolder | None:
    """The newest whole run under `runs` that was to come to the same end as this one would, and was stopped."""
    for folder in sorted((runs / manifest.name).glob("*"), reverse=True):
        try:
            run = open_run(folder)
            ends_alike = (run.manifest.identity, run.manifest.versions) == (manifest.identity, manifest.versions)
            if ends_alike and read_result(folder) is None:
                checkpoint.load(folder, manifest.identity)
                return run
        except RunError:  # it is damaged: another is begun
            continue
    return None


def open_run(folder: Path) -> RunFolder:
    """The run in a folder; RunError where there is none or a part of it is damaged."""
    try:
        manifest = from_json(read_whole(folder / MANIFEST, MAX_FILE_BYTES))
        members = read_archive(read_whole(folder / START, MAX_FILE_BYTES))
        weights = {name.removesuffix(".npy"): from_npy(content) for name, content in members.items()}
    except OSError as error:
        raise NotFoundError(
            f"{folder} is not a run: {error.strerror} ({error.filename})",
            f"a run is a folder with a {MANIFEST}, like runs/GoToObject/20260714T120000Z-1",
        ) from error
    except ValueError as error:
        raise _damaged(folder / START) from error
    if hashes(weights) != manifest.weights:
        raise _damaged(folder / START)
    return RunFolder(folder, manifest, weights)


@contextmanager
def claim(folder: Path) -> Iterator[None]:
    """Hold the run folder; RunError where another living process holds it. The file says who, for people.

    The system lets go of it when its holder dies, however it dies.
    """
    path = folder / "lock"
    with open(_opened(path), "r+", encoding="utf-8") as file:
        try:
            # A POSIX lock, not flock: worker processes that are forked while it is held do not share it.
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except (BlockingIOError, PermissionError):
            raise RunError(f"{folder} is in use by process {_holder(path)}", "wait for it, or stop it first") from None
        file.truncate(0)
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def _opened(path: Path) -> int:
    """A descriptor of the lock; OSError where a link or anything but a file stands there."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666)
    mode = os.fstat(descriptor).st_mode
    if not S_ISREG(mode):
        os.close(descriptor)
        raise irregular(path, mode)
    return descriptor


def _holder(path: Path) -> str:
    number = read_regular(path, MAX_PID_DIGITS).strip()
    return number.decode() if number.isdigit() else "unknown"


def keep_weights(folder: Path, genome: Weights) -> None:
    atomic_write.write(folder / WEIGHTS, to_npy(genome))


def keep_champions(folder: Path, champions: Genomes) -> None:
    """Write the best weights of each attempt [attempts, weights] that has ended."""
    file = BytesIO()
    np.save(file, champions.astype("<f4"), allow_pickle=False)
    atomic_write.write(folder / CHAMPIONS, file.getvalue())


def keep_result(folder: Path, result: Mapping[str, Any]) -> None:
    """Write the result of the run, once it has been kept elsewhere too; it has failed no more."""
    atomic_write.write(folder / RESULT, json.dumps(result, indent=2, allow_nan=False).encode() + b"\n")
    (folder / FAILURE).unlink(missing_ok=True)


def read_result(folder: Path) -> dict[str, Any] | None:
    """The result of the run in a folder; None while it is not finished."""
    try:
        result = parsed(read_whole(folder / RESULT, MAX_FILE_BYTES), MAX_FILE_BYTES)
    except (OSError, ValueError):
        return None
    return result if isinstance(result, dict) else None


def keep_failure(folder: Path, why: str) -> None:
    """Write why a run has come to its end and has taught nothing."""
    atomic_write.write(folder / FAILURE, f"{why}\n".encode())


def read_failure(folder: Path) -> str:
    """Why a run has come to its end and has taught nothing; "" where that is not known."""
    try:
        return read_whole(folder / FAILURE, MAX_FILE_BYTES).decode(errors="replace").rstrip("\n")
    except OSError:
        return ""


def _unused(parent: Path, name: str) -> Path:
    parent.mkdir(parents=True, exist_ok=True)
    folder, number = parent / name, 1
    while True:
        try:
            folder.mkdir()
            return folder
        except FileExistsError:
            number += 1
            folder = parent / f"{name}+{number}"


def _damaged(path: Path) -> RunError:
    return RunError(f"{path} is damaged", "start the lesson again without --resume")
