"""Controllers and guardians that are killed, stopped and told to end at random moments: python -m tests.robot.campaign.

A round starts one to three `mindrun` on one robot, sends signals to any of their processes, lets go on what it has
stopped, and ends. Then every actuator has to be at neutral, and at no time may two have driven.
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot.guardian.client import MAX_REPLACEMENTS
from mindrun.robot.ownership import adopt

from tests.robot.devices import Devices, devices
from tests.robot.driving import MINDRUN
from tests.robot.faults import graph
from tests.robot.guardian.scenes import patient

NEUTRALS = {"left_wheel": 0.5, "right_wheel": 0.5, "claw": 0.0}
SIGNALS = (signal.SIGKILL, signal.SIGKILL, signal.SIGSTOP, signal.SIGSTOP, signal.SIGTERM, signal.SIGCONT)
NEUTRAL = (sys.executable, "-P", "-m", "mindrun.robot.guardian", "--neutral")  # what the service does in the end
PATIENCE = 600.0


@dataclass(slots=True)
class Round:
    """What was started, and what happened to it; `home` stands in the environment of each of its processes."""

    home: Path
    controllers: list["subprocess.Popen[bytes]"] = field(default_factory=list)
    guardians: dict[int, int] = field(default_factory=dict)  # process: that which started it
    sent: list[tuple[str, str, int]] = field(default_factory=list)  # signal, to whom
    lost: set[int] = field(default_factory=set)  # killed, or a guardian that was stopped, which its controller kills
    rescued: bool = False

    def processes(self) -> list[int]:
        """All that live, controllers and guardians."""
        for process in self.controllers:
            process.poll()
        found = [int(each.name) for each in Path("/proc").iterdir() if each.name.isdigit() and self._is_ours(each)]
        own = {process.pid for process in self.controllers}
        for pid in found:
            if pid not in own:
                self.guardians.setdefault(pid, int(_stat(pid)[1]))
        return found

    def signal(self, pid: int, number: signal.Signals) -> None:
        """Send it."""
        try:
            os.kill(pid, number)
        except ProcessLookupError:
            return
        self.sent.append((number.name, "guardian" if pid in self.guardians else "controller", pid))
        if number == signal.SIGKILL or (number == signal.SIGSTOP and pid in self.guardians):
            self.lost |= {pid}

    @property
    def nobody_left(self) -> bool:
        """Whether a guardian's first process was lost, and with it its controller, or all that were to do its work."""
        own = {process.pid for process in self.controllers}
        victims = Counter(parent for pid, parent in self.guardians.items() if pid in self.lost and parent in own)
        return any(parent in self.lost or times > MAX_REPLACEMENTS for parent, times in victims.items())

    def _is_ours(self, process: Path) -> bool:
        try:
            return str(self.home).encode() in (process / "environ").read_bytes() and _stat(int(process.name))[0] != "Z"
        except OSError:
            return False


def _stat(pid: int) -> list[str]:
    """How a process is, and which has started it."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[:2]
    except OSError:
        return ["Z", "0"]


def play(folder: Path, rng: random.Random) -> tuple[Round, Devices]:
    """One round; AssertionError where something moves on, or two drive."""
    bundle, home = folder / "mind.bundle", folder / "robot"
    round_ = Round(home)
    with devices(folder, NEUTRALS) as found:
        wiring = found.wiring(f"campaign {os.getpid()} {rng.random()}")
        write_bundle(bundle, Bundle(Policy(graph("bearing"), {}), {}, wiring))
        with patient({"MIND_ROBOT": str(home / "identity")}):
            adopt(wiring, graph("bearing"))
            _happen(round_, found, bundle, rng)
        _end(round_, found)
        if not found.at_rest:
            assert round_.nobody_left, f"an actuator moves on after {round_.sent} of {round_.guardians}"
            round_.rescued = True
            subprocess.run([*NEUTRAL, bundle], check=True, timeout=PATIENCE)
        assert found.at_rest, "an actuator moves on"
        assert len(set(found.drivers)) == len(found.drivers), "two have driven"
    return round_, found


def _happen(round_: Round, found: Devices, bundle: Path, rng: random.Random) -> None:
    for _ in range(rng.choice((1, 1, 2, 3))):
        command = [*MINDRUN, bundle, "--arm", "--quiet"]
        round_.controllers.append(subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True))
        time.sleep(rng.choice((0.0, 0.3)))
    if rng.random() < 0.8:
        _until_it_moves(found, round_)
    time.sleep(rng.uniform(0.0, 0.5))
    for _ in range(rng.randint(3, 8)):
        if rng.random() < 0.1:
            shutil.rmtree(round_.home, ignore_errors=True)
        if there := round_.processes():
            round_.signal(rng.choice(there), rng.choice(SIGNALS))
        time.sleep(rng.choice((0.0, 0.01, 0.1, 1.0)) * rng.random())


def _until_it_moves(found: Devices, round_: Round) -> None:
    until = time.monotonic() + PATIENCE
    while not found.drivers and round_.processes():
        assert time.monotonic() < until, "it never moves"
        time.sleep(0.05)


def _end(round_: Round, found: Devices) -> None:
    """Tell all controllers to end; where one lives it brings all to neutral, whatever its guardian does."""
    own = {process.pid for process in round_.controllers}
    _wait(round_, own.intersection, {*own})
    if not own & round_.lost and len(round_.lost) < 2:
        assert found.at_rest, f"an actuator moves on after {round_.sent} of {round_.guardians}"
    _wait(round_, set, set())


def _wait(round_: Round, whom: Callable[[Collection[int]], Collection[int]], told: set[int]) -> None:
    """Until those have ended, which are let go on where they were stopped, and told to end."""
    until = time.monotonic() + PATIENCE
    while there := whom(round_.processes()):
        for pid in there:
            _send(pid, signal.SIGCONT)
        for pid in told.intersection(there):
            _send(pid, signal.SIGTERM)
            told.remove(pid)
        assert time.monotonic() < until, "a process does not end"
        time.sleep(0.05)


def _send(pid: int, number: signal.Signals) -> None:
    with suppress(ProcessLookupError):
        os.kill(pid, number)


def rounds(signals: int, seed: int) -> Iterator[tuple[int, Round, Devices]]:
    """Rounds until so many signals have been sent."""
    rng, sent, number = random.Random(seed), 0, 0
    while sent < signals:
        with tempfile.TemporaryDirectory() as folder:
            round_, found = play(Path(folder), rng)
        sent += len(round_.sent)
        number += 1
        yield number, round_, found


def main() -> None:
    """Play, and say what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--signals", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    sent: Counter[tuple[str, str]] = Counter()
    drove = rescued = moved = number = 0
    for number, round_, found in rounds(options.signals, options.seed):
        sent.update((name, whom) for name, whom, _ in round_.sent)
        drove += len(found.drivers)
        moved += bool(found.drivers)
        rescued += round_.rescued
        print(f"round {number}: {sum(sent.values())} signals", flush=True)
    print(f"{sum(sent.values())} signals in {number} rounds; {drove} drove, in {moved} of these")
    print(f"every actuator ended at neutral; {rescued} times only by what the service does in the end")
    for (name, whom), times in sorted(sent.items()):
        print(f"  {name} of a {whom}: {times}")


if __name__ == "__main__":
    main()
