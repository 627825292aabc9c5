"""Do the tests notice what is broken? Breaks a sample of each room in small ways, one at a time.

python benchmarks/mutation [ROOM…] [--sample N] [--seed S] [--log FILE] [--again FILE]

Prints a row for each room, then the mutants that no test noticed. One that cannot be noticed is explained in
explained.toml; the score is the share that was noticed of those that are not explained.
"""

import argparse
import json
import sys
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from time import monotonic

import hypothesis  # imported here, once, for all the processes to come
import lark
import numba
import numpy
import pymunk
import pytest

from benchmarks.mutation.mutants import Mutant, mutants
from benchmarks.mutation.rooms import ROOMS, Room
from benchmarks.mutation.trial import PASSED_CODE, run_tests, survives, workshop

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(__file__).resolve().parent
PRELOADED = (hypothesis, lark, numba, numpy, pymunk, pytest)
MAX_ROOM_SECONDS = 1800.0  # seconds that the tests of a room may take
SLOWER_FACTOR, EXTRA_SECONDS = 5.0, 20.0  # a mutant may take so many times as long, and so many seconds more


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a room's sample."""

    room: str
    tried: int
    survivors: tuple[Mutant, ...]
    explained: int

    @property
    def score(self) -> float:
        """The share that was noticed of what could be."""
        could = self.tried - self.explained
        return (self.tried - len(self.survivors) - self.explained) / could if could else 1.0


def files(room: Room) -> list[Path]:
    """The files of a room."""
    left_out = {path for pattern in room.but for path in ROOT.glob(pattern)}
    return sorted({path for pattern in room.files for path in ROOT.glob(pattern)} - left_out)


def sample(room: Room, count: int, seed: int) -> list[Mutant]:
    """Some of a room's mutants; the same for the same sources and seed."""
    found = [mutant for path in files(room) for mutant in mutants(ROOT, path)]
    return Random(seed).sample(found, min(count, len(found)))


def explained() -> dict[tuple[str, str, str, str], str]:
    """The mutants that no test can notice, and why."""
    listed = tomllib.loads((FOLDER / "explained.toml").read_text(encoding="utf-8")).get("mutant", [])
    return {(one["path"], one["where"], one["was"], one["now"]): one["why"] for one in listed}


def unnoticed(path: Path) -> set[tuple[str, str, str, str]]:
    """The mutants that survived in a log."""
    lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    return {tuple(line["mutant"]) for line in lines if line["survives"]}


def try_room(name: str, chosen: Sequence[Mutant], log: Path | None) -> Outcome:
    """Try a room's mutants one by one."""
    room, reasons = ROOMS[name], explained()
    survivors: list[Mutant] = []
    known = 0
    with workshop(ROOT) as folder:
        tests = tuple(test for test in room.tests if (folder / test.partition("::")[0]).exists())
        began = monotonic()
        if run_tests(folder, tests, room.interpreted, MAX_ROOM_SECONDS) != PASSED_CODE:
            sys.exit(f"{name}: its tests fail as it is\n{(folder / 'output.txt').read_text()[-3000:]}")
        limit = SLOWER_FACTOR * (monotonic() - began) + EXTRA_SECONDS
        for number, mutant in enumerate(chosen, 1):
            began = monotonic()
            lives = survives(folder, mutant, tests, room.interpreted, limit)
            took = monotonic() - began
            note = "survives" if lives else "killed" if took < limit else "killed by time"
            print(f"{name} {number}/{len(chosen)} {note} {took:.0f} s {mutant.path}:{mutant.line}", file=sys.stderr)
            if log:
                record = {"room": name, "mutant": mutant.key, "line": mutant.line, "survives": lives, "seconds": took}
                with log.open("a", encoding="utf-8") as out:
                    out.write(json.dumps(record) + "\n")
            known += lives and mutant.key in reasons
            if lives and mutant.key not in reasons:
                survivors.append(mutant)
    return Outcome(name, len(chosen), tuple(survivors), known)


def show(outcome: Outcome) -> None:
    """A row of the table, and what no test noticed."""
    o = outcome
    print(f"{o.room:10} {o.tried:5} tried {len(o.survivors):4} unnoticed {o.explained:4} explained {o.score:7.1%}")
    for mutant in o.survivors:
        print(f"  {mutant.path}:{mutant.line} {mutant.where}\n    - {mutant.was}\n    + {mutant.now}", flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """1 where something was not noticed in more than a tenth of a room."""
    about = __doc__.split("\n", 1)[0]
    parser = argparse.ArgumentParser(prog="mutation", description=about, allow_abbrev=False)
    parser.add_argument("rooms", nargs="*", metavar="ROOM", help=f"of {', '.join(ROOMS)}; all of them where none")
    parser.add_argument("--sample", type=int, default=30, help="mutants of a room (30)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--log", type=Path, help="a line of JSON for each mutant is added to it")
    parser.add_argument("--again", type=Path, help="only the mutants that survived in that log")
    given = parser.parse_args(arguments)
    if unknown := set(given.rooms) - set(ROOMS):
        parser.error(f"there is no room {', '.join(sorted(unknown))}; there are {', '.join(ROOMS)}")
    outcomes = []
    for name in given.rooms or ROOMS:
        chosen = sample(ROOMS[name], given.sample, given.seed)
        if given.again:
            left = unnoticed(given.again)
            chosen = [m for path in files(ROOMS[name]) for m in mutants(ROOT, path) if m.key in left]
        outcomes.append(try_room(name, chosen, given.log))
        show(outcomes[-1])
    return int(any(outcome.score < 0.9 for outcome in outcomes))


if __name__ == "__main__":
    sys.exit(main())
