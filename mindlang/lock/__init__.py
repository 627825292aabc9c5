"""`collect.lock` beside `collect.mind`: one sorted line per trained skill, made for reading in a review.

Each says what the genome belongs to (`reads` and `sends` in its order), the SHA-256 of its file in `weights/`, and how
it came about. Below the lines stand the worlds in which the skills were taught.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Self
from urllib.parse import unquote

from mindrun.errors import MindError, system_errors_as
from mindrun.files.atomic_write import write
from mindrun.files.printable import visible
from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import Need
from mindrun.kinds.registry import phrase
from mindrun.terminal.command_line import command_line
from msgspec import ValidationError, convert

from mindlang.compiler.source import Source
from mindlang.lock.training_world import HEADING, TrainingWorld, world_of

VERSIONS = ("# mind lock 4:", "# mind lock 5:")
UNRELEASED = ("# mind lock 1:", "# mind lock 2:", "# mind lock 3:")
HEADER = (
    f"{VERSIONS[-1]} what has been taught. `mindc train` writes it; it belongs under version control, with weights/."
)
MAX_LOCK_BYTES = 64 << 20
CONFLICT_MARKS = ("<<<<<<< ", "||||||| ", "=======", ">>>>>>> ")  # as git leaves them
CONFLICT_PARTS = ("<<<<<<< ours", "=======", ">>>>>>> theirs")  # as we do
FILE_ORIGIN = "file:"  # before the name of a file, where weights begin with those in it; no skill's name has a colon

_NAMES = r"[^\s|]+(?: [^\s|]+)*"
_LINE = re.compile(
    rf"(?P<skill>\S+) is (?P<function>{_NAMES}) \| reads (?P<reads>{_NAMES}) \| sends (?P<sends>{_NAMES})"
    r" \| weights (?P<weights>[0-9a-f]{64})"
    r" \| task (?P<task>\S+) master (?P<master>\S+)(?P<jointly> with subskills)?"
    r" generations (?P<generations>[0-9]{1,19}) population (?P<population>[0-9]{1,19})"
    r" seed (?P<seed>[0-9]{1,19}) score (?P<score>-?[0-9]{1,400}(?:\.[0-9]{1,400})?(?:e[+-]?[0-9]{1,3})?)"
    r"(?: success (?P<success>[0-9]\.[0-9]{1,20}))?"
    r"(?: happened (?P<happened>[0-9.]{1,30} [^|,]+?(?:, [0-9.]{1,30} [^|,]+?)*))?"
    r"(?: lesson (?P<number>[0-9]{1,9}) of (?P<curriculum>\S+))?"
    r"(?: \| with (?P<subskills>\S+:[0-9a-f]{64}(?: \S+:[0-9a-f]{64})*))?"
    r"(?: \| from (?P<origin>\S+:[0-9a-f]{64}))?"
    r"(?: \| (?P<how>taught|accepted) in (?P<worlds>[0-9a-f]{16}(?: [0-9a-f]{16})*))?"
)
_EVIDENCE_WORDS = {False: "taught", True: "accepted"}
_NONE: Mapping[str, TrainingWorld] = {}


class LockError(MindError):
    """A lock or a file of weights that is damaged, or cannot be read or written."""


@dataclass(frozen=True, slots=True)
class Signature:
    """The signature of a genome: its function with arguments, and the names that it reads and sends, in its order."""

    function: str
    reads: tuple[str, ...]  # a sensor with several readings says how many: proximity:10
    sends: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Taught:
    """The lesson that made a genome: where, `jointly` with its subskills or theirs, and after how many generations.

    It was lesson `number` of a curriculum; 0 and "" where the lock does not say. `success`
    is the share of runs that succeeded, where its lesson needs some; `happened` says of events that it needs how often
    each did in the mean of all runs: "26.3 reach of ball, 1.2 collision".
    """

    task: str
    master: str
    jointly: bool
    generations: int
    population: int
    seed: int
    score: float
    number: int = 0
    curriculum: str = ""
    success: float | None = None
    happened: str = ""

    def reached(self, need: Need) -> float | None:
        """The figure that a need is about; None where that was not measured."""
        if not need.event:
            return self.score if need.measure == "score" else self.success
        often = (each.partition(" ") for each in self.happened.split(", "))
        return next((float(times) for times, _, event in often if event == phrase(need.event)), None)


@dataclass(frozen=True, slots=True)
class Entry:
    """A line of a lock: a trained skill. `weights` and those of the `subskills` that it was taught with are SHA-256.

    `origin` is the other skill with whose weights it began, and their SHA-256; or the file that they were brought in,
    as `file:NAME`, and its SHA-256; there may be none.
    `worlds` are those of its lessons, the last one last. Where they are `accepted`, they are others than it was taught
    in, and a person has said that its weights will do in them.
    """

    skill: str
    signature: Signature
    weights: str
    taught: Taught
    subskills: tuple[tuple[str, str], ...] = ()
    worlds: tuple[TrainingWorld, ...] = ()
    accepted: bool = False
    origin: tuple[str, str] | None = None
    folder: Path = field(default=Path(), compare=False)  # where the lock stands that it was read from

    @property
    def origin_file(self) -> str:
        """The name of the file in which the weights were brought with which it began; "" where there is none."""
        name = self.origin[0] if self.origin else ""
        return unquote(name.removeprefix(FILE_ORIGIN)) if name.startswith(FILE_ORIGIN) else ""

    def __str__(self) -> str:
        signature, taught = self.signature, self.taught
        parts = [
            f"{self.skill} is {signature.function}",
            f"reads {' '.join(signature.reads)}",
            f"sends {' '.join(signature.sends)}",
            f"weights {self.weights}",
            f"task {taught.task} master {taught.master}{' with subskills' * taught.jointly} "
            f"generations {taught.generations} population {taught.population} "
            f"seed {taught.seed} score {taught.score!r}"
            f"{'' if taught.success is None else f' success {taught.success}'}"
            f"{f' happened {taught.happened}' * bool(taught.happened)}"
            f"{f' lesson {taught.number} of {taught.curriculum}' * bool(taught.number)}",
        ]
        if self.subskills:
            parts.append("with " + " ".join(f"{skill}:{weights}" for skill, weights in self.subskills))
        if self.origin:
            parts.append("from " + ":".join(self.origin))
        if self.worlds:
            parts.append(f"{_EVIDENCE_WORDS[self.accepted]} in " + " ".join(world.name for world in self.worlds))
        return " | ".join(parts)

    @classmethod
    def of(cls, line: str, folder: Path, worlds: Mapping[str, TrainingWorld] = _NONE) -> Self | None:
        """The entry that a line says, whose worlds are among these; or None."""
        found = _LINE.fullmatch(line)
        said = {key: text for key, text in found.groupdict().items() if text is not None} if found else {}
        names = said.get("worlds", "").split()
        try:
            taught = convert(said | {"jointly": "jointly" in said}, Taught, strict=False)
        except ValidationError:  # no line, or a number that is too large
            return None
        if not worlds.keys() >= set(names):
            return None
        return cls(
            said["skill"],
            Signature(said["function"], tuple(said["reads"].split()), tuple(said["sends"].split())),
            said["weights"],
            taught,
            _hashed(said.get("subskills", "")),
            tuple(worlds[name] for name in names),
            said.get("how") == _EVIDENCE_WORDS[True],
            next(iter(_hashed(said.get("origin", ""))), None),
            folder,
        )


Lock = Mapping[str, Entry]
Locks = Mapping[Path, Lock]  # by the path of the lock


def _hashed(text: str) -> tuple[tuple[str, str], ...]:
    """The skills and the SHA-256 of their weights in NAME:SHA."""
    pairs = (part.rpartition(":") for part in text.split())
    return tuple((skill, weights) for skill, _, weights in pairs)


def lock_path(source: Path) -> Path:
    return source.with_suffix(".lock")


def lock_sources(sources: Iterable[Source]) -> list[Path]:
    """The files of a mind whose locks count: those not used under a name, under which skills have other names."""
    return [source.path for source in sources if not source.alias]


def read_lock(path: Path) -> dict[str, Entry]:
    """The entries of a lock by skill, none where there is no such file; LockError where a line cannot be read."""
    try:
        text = read_regular(path, MAX_LOCK_BYTES + 1).decode()
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise LockError(f"{path} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise LockError(f"{path} is damaged: it is not text; get it back, or delete it and train") from error
    header, *rest = text.replace("\r\n", "\n").split("\n")  # git may have written it for Windows
    lines = [(number, line) for number, line in enumerate(rest, 2) if line]
    if marked := next((number for number, line in [(1, header), *lines] if line.startswith(CONFLICT_MARKS)), 0):
        raise LockError(
            f"{path}:{marked} stands where two branches could not be merged: keep one side, without the marks, or let "
            "mindc lock merge do it, and merge again"
        )
    if header.startswith(UNRELEASED):
        raise _unreleased(path)
    if not header.startswith(VERSIONS) or rest[-1:] != [""] or len(text) > MAX_LOCK_BYTES:
        raise LockError(f"{path} is damaged: it is not a whole lock of this mindc; get it back, or delete it and train")
    end = next((place for place, (_, line) in enumerate(lines) if HEADING.fullmatch(line)), len(lines))
    worlds = _worlds(path, lines[end:])
    entries: dict[str, Entry] = {}
    for number, line in lines[:end]:
        entry = Entry.of(line, path.parent, worlds)
        if entry is None or entry.skill in entries:
            why = "this is not what mindc wrote" if entry is None else f"{visible(entry.skill)} has two lines"
            raise LockError(f"{path}:{number} is damaged: {why}; get it back, or delete the line and train")
        if not entry.worlds:  # 0.1.0 kept such lines of what had been before it
            raise _unreleased(path)
        entries[entry.skill] = entry
    return entries


def _unreleased(path: Path) -> LockError:
    """The error for a lock of before the first release, with the way out that keeps its weights."""
    anew = command_line("mindc", "status", path.with_suffix(".mind"), "--accept")
    return LockError(
        f"{path} is a lock of before mindlang 0.1.0, and is read no longer; its weights are still in weights/",
        f"let the mindc of 0.1.0 write it anew: {anew}, and the names of all skills",
    )


def _worlds(path: Path, lines: Sequence[tuple[int, str]]) -> dict[str, TrainingWorld]:
    """The worlds in the numbered lines of a lock below its skills, by name."""
    headings = [place for place, (_, line) in enumerate(lines) if not line.startswith(" ")]
    worlds: dict[str, TrainingWorld] = {}
    for start, end in pairwise([*headings, len(lines)]):
        number, line = lines[start]
        try:
            heading = HEADING.fullmatch(line)
            if heading is None:
                raise ValueError("this is not what mindc wrote")
            worlds[heading["name"]] = world_of(heading["name"], [fact for _, fact in lines[start + 1 : end]])
        except ValueError as error:
            message = f"{path}:{number} is damaged: {visible(str(error))}; get it back, or delete it and train"
            raise LockError(message) from error
    return worlds


def locks_of(sources: Iterable[Path]) -> dict[Path, dict[str, Entry]]:
    """By their paths; LockError where one is damaged."""
    return {path: read_lock(path) for path in map(lock_path, sources)}


def merged(locks: Locks, sources: Iterable[Path]) -> dict[str, Entry]:
    """The entries of the locks of these files, main file first; for a skill in several locks that of the first."""
    known: dict[str, Entry] = {}
    for path in map(lock_path, sources):
        known = {**locks.get(path, {}), **known}
    return known


def read_locks(sources: Sequence[Path]) -> dict[str, Entry]:
    """The entries of a `.mind` file's lock, then of the files that it uses; the first that knows a skill counts."""
    return merged(locks_of(sources), sources)


def lock_text(entries: Lock) -> str:
    """A lock as it is written: sorted, a line per skill, then a block per world."""
    return lock_of({skill: str(entry) for skill, entry in entries.items()}, entries.values())


def lock_of(lines: Mapping[str, str], entries: Iterable[Entry]) -> str:
    """The text of a lock with these lines by skill, and the worlds of these entries."""
    worlds = {world.name: world for entry in entries for world in entry.worlds}
    blocks = ["", *(worlds[name].text() for name in sorted(worlds))] if worlds else []
    return "\n".join([HEADER, *(lines[skill] for skill in sorted(lines)), *blocks, ""])


def write_lock(path: Path, entries: Lock) -> None:
    """Write a lock, sorted; the old one stays until the new one is whole. LockError where that fails."""
    with system_errors_as(LockError, f"{path} cannot be written"):
        write(path, lock_text(entries).encode())


@dataclass(frozen=True, slots=True)
class MergedLock:
    """The lines on which two branches agree, and by skill both lines where both have changed it; None: no line."""

    entries: Lock
    conflicts: Mapping[str, tuple[Entry | None, Entry | None]]

    def text(self) -> str:
        """The lock; of a skill that both have changed both lines, between the marks of git."""
        first, between, last = CONFLICT_PARTS
        lines = {skill: str(entry) for skill, entry in self.entries.items()}
        for skill, (ours, theirs) in self.conflicts.items():
            said = [first, *([str(ours)] if ours else []), between, *([str(theirs)] if theirs else []), last]
            lines[skill] = "\n".join(said)
        both = (side for sides in self.conflicts.values() for side in sides if side)
        return lock_of(lines, [*self.entries.values(), *both])


def merge(base: Lock, ours: Lock, theirs: Lock) -> MergedLock:
    """The lines that one of two branches has changed, added or taken out since `base`, and those that none has."""
    entries: dict[str, Entry] = {}
    conflicts: dict[str, tuple[Entry | None, Entry | None]] = {}
    for skill in sorted({*ours, *theirs}):
        before, own, other = (lock.get(skill) for lock in (base, ours, theirs))
        if own != other and before not in (own, other):
            conflicts[skill] = own, other
        elif now := other if own == before else own:
            entries[skill] = now
    return MergedLock(entries, conflicts)
