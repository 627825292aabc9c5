"""Hold a recording against what the source declares of time: rate, delays, losses.

examples:
  mindrun report day.rec ball.bundle
  mindrun report day.rec ball.bundle --json
"""

import argparse
import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.bundle import digest, read_bundle
from mindrun.graph.graph import Graph, Sensor
from mindrun.graph.recording_header import BY_ACTUATOR, BY_GUARDIAN
from mindrun.kinds.sensors.sensor import Physical
from mindrun.robot.recording import RecordingError, read
from mindrun.robot.sensing import FINE
from mindrun.terminal.standard_streams import document
from mindrun.terminal.tick_count import ticks


def options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("recording", type=Path, help="what mindrun --record wrote")
    parser.add_argument("bundle", type=Path, help="the bundle that was running")
    parser.add_argument("--json", action="store_true", help="one JSON document instead")


def run(options: argparse.Namespace) -> int:
    """Report and print; the exit code, 0 where the robot keeps to what training had, else 1."""
    lines = report(options.recording, digest(options.bundle), read_bundle(options.bundle).graph)
    if options.json:
        document(json.dumps({"lines": [asdict(line) for line in lines]}, indent=2) + "\n")
    else:
        width = max((len(line.what) for line in lines), default=0)
        for line in lines:
            mark = "ok " if line.kept else "NOT"
            print(f"{mark}  {line.what:<{width}}  declared {line.declared:<9}  had {line.had}")
    return 0 if all(line.kept for line in lines) else 1


@dataclass(frozen=True, slots=True)
class TimingLine:
    """A promise of the source, what the robot had, and whether it keeps it; times in seconds, shares of 1."""

    what: str
    declared: str
    had: str
    kept: bool


def report(path: Path, bundle: str, graph: Graph) -> list[TimingLine]:
    """The lines for the tick and for every wired sensor.

    RecordingError where it cannot be read, holds nothing, or was made with another bundle than that of this SHA-256.
    """
    about, parts = read(path)
    about.refuse_another(bundle, graph)
    rows = np.concatenate(list(parts) or [np.zeros(0, about.row)])
    if not len(rows):
        raise RecordingError(f"{path} has no tick in it")
    sensors = {sensor.name: sensor for sensor in graph.sensors}
    with np.errstate(all="ignore"):  # a recording may hold any number
        lines = [*_tick(rows, graph.tick), *_at_neutral(rows, about.actuators)]
        for number, name in enumerate(about.sensors):
            lines += _sensor(rows, number, sensors[name], graph.tick)
    return lines


def _tick(rows: NDArray[Any], tick: float) -> Iterator[TimingLine]:
    if len(rows) < 2:
        return
    apart = np.diff(rows["time"])
    late = float(np.quantile(np.abs(apart - tick), 0.99))
    missed = float((apart > 1.5 * tick).mean())
    had = f"{np.median(apart) * 1e3:.1f} ms, 99 % within {late * 1e3:.1f} ms"
    yield TimingLine("tick", f"{tick * 1e3:.1f} ms", had, late < tick / 2)
    yield TimingLine("ticks missed", "0 %", f"{missed:.2%}", missed < 0.01)


def _at_neutral(rows: NDArray[Any], actuators: Sequence[str]) -> Iterator[TimingLine]:
    """The share of all ticks at neutral; then why the guardian had them there, and since when."""
    stopped, names = rows["stopped"], dict(enumerate(actuators, BY_ACTUATOR))
    yield TimingLine("ticks at neutral", "0 %", f"{(stopped != 0).mean():.2%}", not stopped.any())
    for number in np.unique(stopped[stopped >= BY_GUARDIAN]).tolist():
        by = f"{names[number]} failed" if number in names else "guardian"
        times = rows["time"][stopped == number]
        first = times[0] - rows["time"][0]
        yield TimingLine(f"neutral: {by}", "0 ticks", f"{ticks(len(times))}, first after {first:.2f} s", False)


def _sensor(rows: NDArray[Any], number: int, sensor: Sensor, tick: float) -> Iterator[TimingLine]:
    if not isinstance(sensor.kind, Physical) or np.isnan(rows["ages"][:, number]).all():  # simulated, and never late
        return
    fine = rows["faults"][:, number] == FINE
    ages = rows["ages"][fine, number]
    lost = 1 - float(fine.mean())
    declared = (sensor.kind.delay + sensor.kind.every - 1) * tick  # the oldest that a skill saw in training
    yield TimingLine(f"{sensor.name} lost", f"{sensor.kind.lost:.1%}", f"{lost:.1%}", lost <= sensor.kind.lost + 0.01)
    if len(ages):
        old = float(np.quantile(ages, 0.95))
        had = f"{np.median(ages) * 1e3:.0f} ms, 95 % within {old * 1e3:.0f} ms"
        yield TimingLine(f"{sensor.name} delay", f"{declared * 1e3:.0f} ms", had, old <= declared + 1.1 * tick)
