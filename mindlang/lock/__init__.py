"""`collect.lock` beside `collect.mind`: one sorted line per trained skill, made for reading in a review.

Each says what the genome belongs to (`reads` and `sends` in its order), the SHA-256 of its file in `weights/`, and how
it came about.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from mindrun.durable import write
from mindrun.errors import MindError

VERSION = "# mind lock 1:"
HEADER = f"{VERSION} what has been taught. `mindc train` writes it; it belongs under version control, with weights/."
LARGEST = 1 << 20

_NAMES = r"[^\s|]+(?: [^\s|]+)*"
_LINE = re.compile(
    rf"(?P<skill>\S+) is (?P<function>{_NAMES}) \| reads (?P<reads>{_NAMES}) \| sends (?P<sends>{_NAMES})"
    r" \| weights (?P<weights>[0-9a-f]{64})"
    r" \| task (?P<task>\S+) master (?P<master>\S+)(?P<jointly> with subskills)?"
    r" generations (?P<generations>\d+) population (?P<population>\d+)"
    r" seed (?P<seed>\d+) score (?P<score>-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)"
    r"(?: \| with (?P<subskills>\S+:[0-9a-f]{64}(?: \S+:[0-9a-f]{64})*))?"
)


class LockError(MindError):
    """A lock or a file of weights that is damaged, or cannot be read or written."""


@dataclass(frozen=True, slots=True)
class Signature:
    """What a genome fits: the function with its arguments, and by name what it reads and sends, in its order."""

    function: str
    reads: tuple[str, ...]  # a sensor with several readings says how many: proximity:10
    sends: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Taught:
    """How a genome came about: where, `jointly` with its subskills or theirs, and after how many generations."""

    task: str
    master: str
    jointly: bool
    generations: int
    population: int
    seed: int
    score: float


@dataclass(frozen=True, slots=True)
class Entry:
    """One line: a trained skill. `weights` and those of the `subskills` that it was taught with are SHA-256."""

    skill: str
    signature: Signature
    weights: str
    taught: Taught
    subskills: tuple[tuple[str, str], ...] = ()
    folder: Path = field(default=Path(), compare=False)  # where the lock stands that it was read from

    def __str__(self) -> str:
        """The line."""
        signature, taught = self.signature, self.taught
        parts = [
            f"{self.skill} is {signature.function}",
            f"reads {' '.join(signature.reads)}",
            f"sends {' '.join(signature.sends)}",
            f"weights {self.weights}",
            f"task {taught.task} master {taught.master}{' with subskills' * taught.jointly} "
            f"generations {taught.generations} population {taught.population} "
            f"seed {taught.seed} score {taught.score!r}",
        ]
        if self.subskills:
            parts.append("with " + " ".join(f"{skill}:{weights}" for skill, weights in self.subskills))
        return " | ".join(parts)

    @classmethod
    def of(cls, line: str, folder: Path) -> Self | None:
        """The entry that a line says, or None."""
        found = _LINE.fullmatch(line)
        if found is None:
            return None
        signature = Signature(found["function"], tuple(found["reads"].split()), tuple(found["sends"].split()))
        generations, population, seed = (int(found[key]) for key in ("generations", "population", "seed"))
        where = found["task"], found["master"], found["jointly"] is not None
        taught = Taught(*where, generations, population, seed, float(found["score"]))
        pairs = (part.rpartition(":") for part in (found["subskills"] or "").split())
        return cls(found["skill"], signature, found["weights"], taught, tuple((a, c) for a, _, c in pairs), folder)


Lock = Mapping[str, Entry]


def lock_path(source: Path) -> Path:
    """The lock of a `.mind` file."""
    return source.with_suffix(".lock")


def read_lock(path: Path) -> dict[str, Entry]:
    """The entries of a lock by skill, none where there is no such file; LockError where a line cannot be read."""
    try:
        with path.open("rb") as file:
            text = file.read(LARGEST + 1).decode()
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise LockError(f"{path} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise LockError(f"{path} is damaged: it is not text; get it back, or delete it and train") from error
    header, *lines = text.split("\n")
    if not header.startswith(VERSION) or lines[-1:] != [""] or len(text) > LARGEST:
        raise LockError(f"{path} is damaged: it is not a whole lock of this mindc; get it back, or delete it and train")
    entries: dict[str, Entry] = {}
    for number, line in enumerate(lines[:-1], 2):
        entry = Entry.of(line, path.parent)
        if entry is None or entry.skill in entries:
            why = "this is not what mindc wrote" if entry is None else f"{entry.skill} has two lines"
            raise LockError(f"{path}:{number} is damaged: {why}; get it back, or delete the line and train")
        entries[entry.skill] = entry
    return entries


def read_locks(sources: Iterable[Path]) -> dict[str, Entry]:
    """The entries of a `.mind` file's lock, then of the files that it uses; the first that knows a skill counts."""
    known: dict[str, Entry] = {}
    for source in sources:
        known = read_lock(lock_path(source)) | known
    return known


def lock_text(entries: Lock) -> str:
    """A lock as it is written: sorted, a line per skill."""
    return "\n".join([HEADER, *(str(entries[skill]) for skill in sorted(entries)), ""])


def write_lock(path: Path, entries: Lock) -> None:
    """Write a lock, sorted; the old one stays until the new one is whole. LockError where that fails."""
    try:
        write(path, lock_text(entries).encode())
    except OSError as error:
        raise LockError(f"{path} cannot be written: {error.strerror}") from error
