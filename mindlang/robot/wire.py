"""`robot.yaml` → Wiring, checked against a mind; for any text without an exception."""

from dataclasses import dataclass
from pathlib import Path

from mindrun.errors import nearest, reason
from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import Wiring

from mindlang.compiler.diagnostic import Diagnostic, Findings, errors, near_file
from mindlang.compiler.source import Source, decode
from mindlang.robot.claims import check_claims
from mindlang.robot.nodes import Node, TableEntry, report_error
from mindlang.robot.read import read
from mindlang.robot.section import actuators, sensors
from mindlang.robot.speed import check_shared
from mindlang.robot.values import is_empty, missing_key, table, text, unknown_key

MAX_WIRING_BYTES = 256 << 10
KEYS = {
    "robot": "paper, or another name",
    "sensors": "and below it each of them with its driver",
    "actuators": "and below it each of them with its driver",
}


@dataclass(frozen=True, slots=True)
class Checked:
    """What became of a wiring; `wiring` is None where the diagnostics hold an error."""

    wiring: Wiring | None
    diagnostics: tuple[Diagnostic, ...]
    readable: bool = True


def load_wiring(path: Path, graph: Graph, unit_metres: float | None = None) -> Checked:
    """The wiring of a mind in the file at `path`; whatever is wrong is in the diagnostics.

    `unit_metres` is how long a unit of the mind's world is on the robot, where the mind says so.
    """
    try:
        if path.is_dir():
            raise ValueError("is a folder")
        data = read_regular(path, MAX_WIRING_BYTES + 1)
        if len(data) > MAX_WIRING_BYTES:
            raise ValueError(f"is larger than {MAX_WIRING_BYTES >> 10} kB")
        return check_wiring(Source(str(path), decode(data), path.resolve().parent), graph, unit_metres)
    except (OSError, RuntimeError) as error:  # a loop of links is a RuntimeError
        return _unreadable(f"{path} cannot be read: {reason(error)}.", near_file(path))
    except ValueError as error:
        return _unreadable(f"{path} {error}.", f"A robot.yaml is UTF-8 text of at most {MAX_WIRING_BYTES >> 10} kB.")


def _unreadable(message: str, hint: str) -> Checked:
    return Checked(None, (Diagnostic("unreadable", message, None, hint),), readable=False)


def check_wiring(source: Source, graph: Graph, unit_metres: float | None = None) -> Checked:
    """The wiring that a text says, checked against a mind with its master."""
    findings = Findings()
    node = read(source, findings)
    wiring = _wiring(node, graph, unit_metres, findings) if node else None
    found = sorted(findings.diagnostics, key=lambda diagnostic: diagnostic.span.start if diagnostic.span else -1)
    return Checked(None if errors(found) else wiring, tuple(found))


def _wiring(node: Node, graph: Graph, unit_metres: float | None, findings: Findings) -> Wiring | None:
    top = table(node, "The file", "robot, sensors and actuators", findings)
    if top is None:
        return None
    said = {entry.key.text: entry for entry in top.entries}
    strange = [entry.key for entry in top.entries if entry.key.text not in KEYS]
    for key in strange:
        unknown_key(key, "The file", KEYS, findings)
    meant = {nearest(key.text, KEYS) for key in strange}
    for word, example in KEYS.items():
        if word not in said and word not in meant and top.whole:
            missing_key(top.span, "The file", word, example, findings)
    sensing = sensors(said.get("sensors"), graph, unit_metres, findings)
    acting = actuators(said.get("actuators"), graph, findings)
    check_claims([wired for wired, _ in (*sensing, *acting)], findings)
    check_shared(sensing, acting, graph.tick, findings)
    name = _name(said.get("robot"), findings)
    wires = tuple(wire for _, wire in sensing if wire)
    return Wiring(name, wires, tuple(wire for _, wire in acting if wire)) if name else None


def _name(entry: TableEntry | None, findings: Findings) -> str | None:
    if entry is None or is_empty(entry, findings):
        return None
    name = text(entry.value, findings)
    if name and name.strip() != name:
        report_error(findings, "not-a-text", entry.value.span, "A name has no spaces around it.", "Remove them.")
    return name
