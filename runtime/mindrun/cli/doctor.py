"""Say what a robot has, what is wired to it, what answers, and what to install.

Nothing is moved: sensors are read once, actuators are left alone. `ok` answers, `-` is not there and needed only by
what uses it, `NOT` has to be mended. Ends with 0, or with 1 where something has to be mended.

examples:
  mindrun doctor
  mindrun doctor ball.bundle
  mindrun doctor ball.bundle --json
"""

import argparse
import json
import os
import platform
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from threading import Thread

from mindrun.driver import driver_name
from mindrun.graph.bundle import read_bundle
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import SensorWire, Wiring, reckoned, still
from mindrun.robot.processes import refuse_success
from mindrun.robot.sensing import Sample, Sampler
from mindrun.terminal.standard_streams import document

SENSOR_SECONDS = 3.0  # for a sensor to answer
PACKAGES = {  # that drivers may need, and the line that installs each
    "numpy": "pip install numpy",
    "smbus2": "pip install smbus2",
    "gpiozero": "sudo apt install python3-gpiozero",
    "lgpio": "sudo apt install python3-lgpio",
    "cv2": "pip install 'opencv-python-headless>=4.10,<6'",
}
FINE, ABSENT, WRONG = "ok ", "-  ", "NOT"  # what is absent is no fault before something needs it
STATES = {FINE: "ok", ABSENT: "absent", WRONG: "wrong"}  # in a document


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The result of one check: what was checked, OK or not, and what to do."""

    what: str
    mark: str
    words: str


def options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("bundle", type=Path, nargs="?", help="look at what this bundle is wired to, as well")
    parser.add_argument("--json", action="store_true", help="one JSON document instead")


def run(options: argparse.Namespace) -> int:
    """Check and print; the exit code, 0 where everything that is wired answers, else 1."""
    findings = [*machine()]
    if options.bundle:
        bundle = read_bundle(options.bundle)
        with refuse_success():
            wrong = CheckResult("bundle", WRONG, "it is wired to no robot")
            findings += wired(bundle.wiring, bundle.graph) if bundle.wiring else [wrong]
    is_fine = all(finding.mark != WRONG for finding in findings)
    if options.json:
        data = [{"what": each.what, "state": STATES[each.mark], "seen": each.words} for each in findings]
        document(json.dumps({"ok": is_fine, "checks": data}, indent=2) + "\n")
    else:
        width = max(len(finding.what) for finding in findings)
        for finding in findings:
            print(f"{finding.mark}  {finding.what:<{width}}  {finding.words}")
    return 0 if is_fine else 1


def machine() -> Iterator[CheckResult]:
    """The machine, and what is installed and connected."""
    system = f"{platform.machine()}, {platform.platform(terse=True)}, Python {platform.python_version()}"
    yield CheckResult("machine", FINE, system)
    for package, line in PACKAGES.items():
        if find_spec(package) is not None:
            yield CheckResult(package, FINE, "installed")
        else:
            yield CheckResult(package, WRONG if package == "numpy" else ABSENT, f"not installed: {line}")
    for device, group in (("i2c-1", "i2c"), ("gpiochip0", "gpio"), ("video0", "video")):
        path = Path("/dev") / device
        if path.exists():
            may = os.access(path, os.R_OK | os.W_OK)
            words = "you may use it" if may else f"you may not use it: sudo usermod -aG {group} $USER, and log in again"
            yield CheckResult(str(path), FINE if may else WRONG, words)
        else:
            yield CheckResult(str(path), ABSENT, "not there")


def wired(wiring: Wiring, graph: Graph) -> Iterator[CheckResult]:
    """Every sensor, read once; every direction that is reckoned; every actuator, by the name of its driver."""
    for wire in wiring.sensors:
        sample = answered(wire)
        kind = driver_name(wire.driver)
        if sample is None:
            yield CheckResult(wire.sensor, WRONG, f"{kind} has not answered within {SENSOR_SECONDS:g} s")
        else:
            values = " ".join("-" if value is None else f"{value:.3g}" for value in sample.values)
            words = sample.fault or f"{kind} reads {values} {wire.driver.unit}".rstrip()
            yield CheckResult(wire.sensor, WRONG if sample.fault else FINE, words)
    for sensor, servo in reckoned(wiring, graph).items():
        yield CheckResult(sensor, FINE, f"reckoned from what {servo} is sent")
    for end in wiring.actuators:
        yield CheckResult(end.actuator, FINE, f"{driver_name(end.driver)}, left alone")


def answered(wire: SensorWire) -> Sample | None:
    """One measurement; None where it takes too long."""
    sampler = Sampler(still(wire))
    came: list[Sample] = []
    thread = Thread(target=lambda: came.append(sampler.measured_once()), daemon=True)
    thread.start()
    thread.join(SENSOR_SECONDS)
    return came[0] if came else None
