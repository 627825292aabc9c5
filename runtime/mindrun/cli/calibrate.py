"""Watch a sensor or turn a motor, and print the lines for robot.yaml that this calls for.

Of a sensor: move what it measures through its whole range while it runs; then let it rest. Nothing is moved by the
robot.

Of a wheel or a motor: how much of a command it needs to start. With the wheels off the ground and --arm its command is
raised by 1% of the way each half second, forward and then backward, until you press Enter or its encoder sees it move.

examples:
  mindrun calibrate ball.bundle proximity
  mindrun calibrate ball.bundle ball_bearing --seconds 30
  mindrun calibrate ball.bundle left_wheel --arm
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median, pstdev
from time import monotonic, sleep

from mindrun.errors import MindError
from mindrun.files.printable import visible
from mindrun.graph.bundle import read_bundle
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import SensorWire, Wiring, reading, still
from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.robot.least_command import measured_least
from mindrun.robot.ownership import is_adopted
from mindrun.robot.processes import refuse_success
from mindrun.robot.sensing import Sample, Sampler
from mindrun.terminal.arguments import real
from mindrun.terminal.standard_streams import draw

MAX_SECONDS = 3600.0
NOISE_VALUES = 10  # that follow one another, over which noise is measured


def options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("bundle", type=Path, help="what `mindc build --robot` wrote")
    parser.add_argument("part", help="a sensor that is wired, or what drives")
    parser.add_argument("--arm", action="store_true", help="let the motor turn: without it nothing moves")
    parser.add_argument(
        "--seconds", type=real(0, MAX_SECONDS), default=20.0, metavar="S", help="how long to watch (default: 20)"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code, 0 where something was measured, else 1."""
    bundle = read_bundle(options.bundle)
    if bundle.wiring is None:
        raise MindError("this bundle is wired to no robot", "mindc build … --robot robot.yaml")
    wires = {wire.sensor: wire for wire in bundle.wiring.sensors}
    motors = {each.name: each.kind for each in bundle.graph.actuators if each.kind.is_motor}
    if options.part in motors:
        return _least(bundle.graph, bundle.wiring, options.part, motors[options.part], options.arm)
    if options.part not in wires:
        raise MindError(f"no sensor or motor {options.part} is wired", f"there are {', '.join([*wires, *motors])}")
    wire = still(wires[options.part])
    kind = next(known.kind for known in bundle.graph.sensors if known.name == wire.sensor)
    with refuse_success():
        samples = _watched(wire, kind, options.seconds)
    good = [sample for sample in samples if not sample.fault]
    for why in sorted({sample.fault for sample in samples if sample.fault}):
        print(f"{wire.sensor} {why}", file=sys.stderr)
    if not good:
        print("nothing has been measured", file=sys.stderr)
        return 1
    print("\n".join(lines(wire, good, kind)))
    return 0


def _least(graph: Graph, wiring: Wiring, name: str, kind: ActuatorKind, is_armed: bool) -> int:
    """Measure and print what share of a command a motor needs to start; the exit code."""
    if not is_armed:
        raise MindError(f"{name} has to turn for this, and nothing moves yet", "wheels off the ground, then add --arm")
    if not is_adopted(wiring, graph):
        raise MindError("nothing may move yet: this robot has not said how it is wired", "mindrun adopt FILE.bundle")
    kinds = {sensor.name: sensor.kind for sensor in graph.sensors}
    eye = next((wire for wire in wiring.sensors if kinds[wire.sensor].sees(kind)), None)
    when = f"if you see it move before {eye.sensor} does" if eye else "as soon as it moves"
    print(f"{name} turns slowly: wheels off the ground! Press Enter {when}, Ctrl-C to end.", file=sys.stderr)
    try:
        with refuse_success("; every actuator comes to neutral"):
            found = measured_least(graph, wiring, name, eye, lambda sentence: _draw(f"{name} {sentence}"))
    finally:
        _end_line()
    print("\n".join(least_lines(name, kind, found)))
    return 0


def least_lines(name: str, kind: ActuatorKind, found: Mapping[str, float]) -> list[str]:
    """The lines for robot.yaml and for the .mind file, where a motor starts at these shares of a command."""
    said = [f"# {name} starts at " + " and ".join(f"{share:.0%} {way}" for way, share in found.items())]
    least = max(found.values())
    said += [f"{name}:", f"  least: {least:.0%}"]
    if hasattr(kind, "starts"):
        said.append(f"# or in the .mind file, where robot.yaml has no least: starts {least:.0%}")
    return said


def _watched(wire: SensorWire, kind: SensorKind, seconds: float) -> list[Sample]:
    """The samples of so many seconds, or until Ctrl-C, each shown as it comes."""
    sampler, samples = Sampler(wire), list[Sample]()
    until = monotonic() + seconds
    sampler.start()
    try:
        while monotonic() < until:
            latest = sampler.latest
            if latest and (not samples or latest is not samples[-1]):
                samples.append(latest)
                values = ((raw, reading(wire, raw, kind.circular)) for raw in latest.values)
                pairs = (f"{'-' if raw is None else f'{raw:.3g}'} → {value:.2f}" for raw, value in values)
                _draw(latest.fault or "  ".join(pairs))
            sleep(0.2 / wire.rate)
    except KeyboardInterrupt:
        pass  # that is enough
    finally:
        sampler.stop()
    _end_line()
    return samples


def _draw(text: str) -> None:
    """Write a line over the one before, in a terminal."""
    if sys.stderr.isatty():
        draw(f"\r\033[K{visible(text)}"[:160])


def _end_line() -> None:
    if sys.stderr.isatty():
        print(file=sys.stderr)


@dataclass(frozen=True, slots=True)
class ReadingStatistics:
    """Statistics of a reading; `noise` is its standard deviation at rest, `lost` the share without a value."""

    low: float
    high: float
    noise: float
    lost: float


def reading_statistics(values: Sequence[float | None], turn: float | None = None) -> ReadingStatistics | None:
    """The statistics of these values, None standing for a lost one; None where all were lost.

    Of directions, which begin anew after a whole `turn`, the range may go beyond one: 175 to 190.
    """
    there = [value for value in values if value is not None]
    if not there:
        return None
    spans = [there[i : i + NOISE_VALUES] for i in range(max(1, len(there) - NOISE_VALUES + 1))]
    noise = min(pstdev(_going_round(span, turn)) for span in spans)
    ends = ((min(each), max(each)) for each in (there, _going_round(there, turn)))
    low, high = min(ends, key=lambda each: each[1] - each[0])
    return ReadingStatistics(low, high, noise, 1 - len(there) / len(values))


def _going_round(values: Sequence[float], turn: float | None) -> Sequence[float]:
    """Directions, each the short way from the first; all else as it is."""
    first = values[0]
    return [first + (value - first + turn / 2) % turn - turn / 2 for value in values] if turn else values


def lines(wire: SensorWire, samples: Sequence[Sample], kind: SensorKind) -> list[str]:
    """The lines for robot.yaml, with what they rest on as comments.

    Where the kind of the sensor is `scaled`, as distances and directions are, the range of training stays.
    """
    turn = abs(wire.high - wire.low) if kind.circular else None
    values = zip(*(sample.values for sample in samples), strict=True)
    columns = [reading_statistics(column, turn) for column in values]
    known = [column for column in columns if column]
    said = [f"# {wire.sensor}: {len(samples)} measurements, in {wire.driver.unit or 'units of its own'}"]
    for number, column in enumerate(columns):
        what = "nothing measured" if column is None else (
            f"{column.low:.4g} to {column.high:.4g}, noise {column.noise:.2g}, lost {column.lost:.0%}"
        )  # fmt: skip
        said.append(f"#   reading {number}: {what}")
    if not known:
        return said
    low, high = min(column.low for column in known), max(column.high for column in known)
    if kind.scaled:
        said.append(
            f"# from and to are those of training ({wire.low:g} to {wire.high:g}), and no matter of what was seen"
        )
    elif low < high:
        first, last = (low, high) if wire.low <= wire.high else (high, low)
        said += [f"{wire.sensor}:", f"  from: {_written(first, wire)}", f"  to: {_written(last, wire)}"]
    else:
        said.append("# it has not changed: move what it measures")
    noise = median(column.noise for column in known) / abs(wire.high - wire.low)
    lost = max(column.lost for column in known)
    said.append(f"# for the .mind file: noise {2 * noise:.1%} dead_zone {3 * noise:.1%} lost {lost:.0%}")
    return said


def _written(value: float, wire: SensorWire) -> str:
    """A value as robot.yaml takes it: no exponent, and with its unit."""
    number = f"{value:.6f}".rstrip("0").rstrip(".")
    return f"{number} {wire.driver.unit}".replace("²", "2").strip()
