"""Guardians, drivers and controllers that end in every way: python -m tests.robot.guardian.ends [--rounds 1000].

In a round each actuator may have a driver that does harm, and something ends the controller or the guardian. Then
every actuator whose own driver still can is at neutral, and nobody has said so of one that is not.
"""

import argparse
import os
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from tests.robot.guardian.hostile import HARM, NEUTRALS, WHEN

PROGRAM = Path(__file__).with_name("hostile.py")
NAMES = ("left_wheel", "right_wheel", "claw")
ENDS = ("_exit", "error", "hang", "done", "SIGKILL", "SIGSTOP", "SIGTERM")  # of a controller
LOSSES = ("worker SIGKILL", "worker SIGSTOP", "worker SIGTERM", "watcher SIGKILL", "watcher SIGSTOP", "watcher SIGTERM")
HARMLESS = ("SIGTERM", "close", "fork", "stay", "print")  # whoever does it writes nevertheless
PATIENCE = 600.0  # seconds for processes to end; they decide nothing


@dataclass(slots=True)
class Round:
    """What was to happen, and what is in the log of it."""

    manners: list[str]
    ends: str
    log: Path
    happened: list[tuple[float, str]] = field(default_factory=list)  # ends, when they happened

    @property
    def able(self) -> list[int]:
        """The channels whose own driver can write neutral in a new process."""
        parts = [manner.partition("@") for manner in self.manners]
        return [
            channel
            for channel, (how, _, when) in enumerate(parts)
            if how in HARMLESS or when == "close" or not (when in ("open", "neutral") or _lasts(how, when))
        ]

    @property
    def is_at_rest(self) -> bool:
        """Whether all are at neutral that can be brought there."""
        last = self.last
        return all(last[channel] == NEUTRALS[channel] for channel in self.able)

    @property
    def last(self) -> list[float | None]:
        """What each was told last."""
        found: list[float | None] = [None] * len(NAMES)
        for _, channel, value in self.told:
            found[channel] = value
        return found

    @property
    def told(self) -> Iterator[tuple[float, int, float]]:
        """When who was told what."""
        for line in self.log.read_text().splitlines():
            at, first, *rest = line.split()
            if first.isdigit():
                yield int(at) / 1e9, int(first), float(rest[0])

    @property
    def said(self) -> str:
        """How the controller says that it ended."""
        return "".join(line.partition(" said ")[2] for line in self.log.read_text().splitlines())

    def check(self) -> None:
        """AssertionError where an actuator moves on that could be stopped, or is said to be at neutral and is not."""
        moving = [channel for channel, value in enumerate(self.last) if value not in (None, NEUTRALS[channel])]
        story = f"{self.manners} {self.ends}: {self.last}\n{self.log.read_text()}"
        assert self.is_at_rest, story
        is_all = "with every actuator at neutral" in self.said or "another has brought" in self.said
        said = NAMES if is_all else self.said.partition("at neutral: ")[2].split("; ")[0].split(", ")
        assert not [channel for channel in moving if NAMES[channel] in said], f"it is said to be at neutral: {story}"

    def seconds(self) -> float:
        """From the first end to the last neutral of what can be stopped."""
        times, moved = [0.0], set[int]()
        first = min(at for at, _ in self.ended)
        for at, channel, value in self.told:
            if value != NEUTRALS[channel]:
                moved.add(channel)
            elif channel in moved and channel in self.able:
                moved.remove(channel)
                times.append(at - first)
        return max(times)

    @property
    def kind(self) -> str:
        """What ended first, and whether something else did."""
        first, *more = [what for _, what in sorted(self.ended)]
        whose = "controller" if first in ENDS else "driver" if first == "driver" else "guardian"
        return f"{whose} {first}" + ", a driver" * ("driver" in more and whose != "driver")

    @property
    def ended(self) -> list[tuple[float, str]]:
        """All ends: of the controller, and of a guardian."""
        found = [*self.happened]
        for line in self.log.read_text().splitlines():
            at, what, *rest = line.split(maxsplit=3)
            if what == "end":
                found.append((int(at) / 1e9, " ".join(rest)))
            elif what == "harm" and rest[1] not in ("raise", "unsaid", "exit", "hang", "fork", "stay", "print"):
                found.append((int(at) / 1e9, "driver"))
        return found


def play(folder: Path, rng: random.Random) -> Round:
    """One round, and its log, when all processes have ended."""
    log = folder / "log"
    log.write_text("")
    manners = [_manner(rng) if rng.random() < 0.45 else "fine" for _ in NAMES]
    round_ = Round(manners, rng.choice((*ENDS, *LOSSES)), log)
    inside = round_.ends if round_.ends in ("_exit", "error", "hang", "done") else "never"
    seconds = rng.uniform(0.0, 0.3)
    environment = {
        **os.environ,
        "MIND_LOG": str(log),
        "MIND_MANNERS": ",".join(manners),
        "PYTHONPATH": os.pathsep.join([str(Path.cwd()), *sys.path]),
    }
    command = [sys.executable, str(PROGRAM), "drive", inside, str(seconds)]
    controller = subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, start_new_session=True
    )
    assert controller.stdout
    if (pids := controller.stdout.readline().split()) and inside == "never":
        time.sleep(seconds)
        _signal(round_, controller, dict(zip(("worker", "watcher"), map(int, pids), strict=True)))
    controller.wait(PATIENCE)
    controller.stdout.close()
    _until_at_rest(round_)
    return round_


def _lasts(how: str, when: str) -> bool:
    """Whether this goes on for as long as the process lives, which it does not end."""
    return how == "hang" or (when == "stop" and how in ("raise", "unsaid", "exit"))


def _manner(rng: random.Random) -> str:
    when = rng.choice(WHEN)
    return f"{rng.choice([*HARM])}@{when}" + f" {rng.randint(2, 20)}" * (when == "write")


def _signal(round_: Round, controller: "subprocess.Popen[str]", guardian: dict[str, int]) -> None:
    """Do what ends the controller or the guardian, and what lets the round come to its end."""
    whom, _, name = round_.ends.rpartition(" ")
    pid = guardian[whom] if whom else controller.pid
    if round_.ends != "watcher SIGSTOP":  # which ends nothing
        round_.happened.append((time.monotonic(), round_.ends))
    with suppress(ProcessLookupError):
        os.kill(pid, signal.Signals[name])
    if name == "SIGSTOP":
        time.sleep(0.4)
        if whom == "watcher":
            round_.happened.append((time.monotonic(), "SIGKILL"))
        controller.kill()
        if whom:
            time.sleep(0.2)
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGCONT)


def _until_at_rest(round_: Round) -> None:
    """Then what still waits for an actuator that nobody can stop is ended."""
    until = time.monotonic() + PATIENCE
    while there := _processes(round_.log):
        assert time.monotonic() < until, f"a process does not end: {round_.manners} {round_.ends}"
        if round_.is_at_rest:
            for pid in there:
                with suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
        time.sleep(0.02)


def _processes(log: Path) -> list[int]:
    """All of a round that live."""
    found = []
    for each in Path("/proc").iterdir():
        with suppress(OSError):
            if each.name.isdigit() and f"MIND_LOG={log}\0".encode() in (each / "environ").read_bytes():
                found.append(int(each.name))
    return found


def rounds(count: int, seed: int, folder: Path, at_once: int) -> Iterator[Round]:
    """So many rounds, each checked, some at once."""

    def once(number: int) -> Round:
        home = folder / str(number)
        home.mkdir()
        round_ = play(home, random.Random(f"{seed} {number}"))
        round_.check()
        return round_

    with ThreadPoolExecutor(at_once) as pool:
        yield from pool.map(once, range(count))


def main() -> None:
    """Play, and say what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at-once", type=int, default=3)
    options = parser.parse_args()
    times: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for number, round_ in enumerate(rounds(options.rounds, options.seed, Path(folder), options.at_once)):
            if round_.ended:
                times.setdefault(round_.kind, []).append(round_.seconds())
            if number % 50 == 49:
                print(f"{number + 1} rounds, load {os.getloadavg()[0]:.1f}", flush=True)
    print("every actuator ended at neutral that could, and none was said to be that was not")
    for kind, found in sorted(times.items()):
        median, most = 1e3 * statistics.median(found), 1e3 * max(found)
        print(f"{kind:28} {len(found):4} rounds, median {median:5.1f} ms, max {most:5.1f} ms")


if __name__ == "__main__":
    main()
