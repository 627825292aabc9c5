"""A release: a folder with the bundle, the mindrun that reads it and its services; its name stands for every byte."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import mindrun
from mindrun.errors import ProcedureError
from mindrun.files.regular_files import read_whole
from mindrun.graph.bundle import MAX_BUNDLE_BYTES, Bundle
from mindrun.graph.weights import reachable
from mindrun.graph.wiring import code_digests
from mindrun.kinds.procedure_text import fit, module_of

from mindlang.robot import DeployError

WORKSTATION = "sim"  # the room of mindrun that no robot has a use for
SERVICE, ARMED = "mind.service", "mind-armed.service"  # what they are called in a release
PYTHON = "%h/mind/venv/bin/python"
UNIT = """\
# Written by `mindc deploy`, which replaces it; `systemctl --user edit mind.service` is for changes that stay.
[Unit]
Description=The mind of this robot, {state}
StartLimitIntervalSec=60
StartLimitBurst=5

[Service]
# Ready when every sensor has been measured once; then each tick is told, and two seconds without one are the end.
Type=notify
NotifyAccess=main
WatchdogSec=2
# Entered once: a process keeps the release that it was started in, whatever is current later.
WorkingDirectory=%h/mind/current
# No .pyc files: a release stays what was sent, and a power cut leaves none that is half written.
Environment=PYTHONPATH=runtime PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1
ExecStart={run}
{neutral}Restart=on-failure
# 2 is said on purpose: a bundle that is refused, or a guardian that will move nothing more.
RestartPreventExitStatus=2
RestartSec=2
# Only the controller is told to end; the guardian ends after it, once every actuator is at neutral.
KillMode=mixed
TimeoutStopSec=10
LimitCORE=0
NoNewPrivileges=yes

[Install]
WantedBy=default.target
"""


@dataclass(frozen=True, slots=True)
class Release:
    """A release that lies in a folder here: `fingerprint` is the SHA-256 of its SHA256SUMS."""

    folder: Path
    fingerprint: str
    size: int

    def named(self, moment: str) -> str:
        """What it is called on the robot: names sort by their age."""
        return f"{moment}-{self.fingerprint[:8]}"


def check_deployable(bundle: Bundle, with_service: bool) -> None:
    """Refuse procedures of which the text says that they could not run, and a service that would have no wiring."""
    for skill in reachable(bundle.graph, bundle.graph.master):
        if (calls := skill.function.calls) is not None:
            try:
                fit(calls, bundle.procedures.get(module_of(calls), ""), len(skill.inputs), skill.outputs)
            except ProcedureError as error:
                raise DeployError(f"{error}.", error.hint or "Mend it, and build the bundle anew.") from error
    if with_service and bundle.wiring is None:
        raise DeployError(
            "This bundle does not say how the robot is wired, so no service can run it.",
            "Build it with its robot.yaml, or use --no-service to bring it there all the same.",
        )


def make_release(path: Path, bundle: Bundle, folder: Path) -> Release:
    """Lay a release out in an empty folder. The same bundle and the same mindrun have the same fingerprint."""
    data = read_whole(path, MAX_BUNDLE_BYTES)
    made_of: dict[str, object] = {"bundle": path.name, "sha256": sha256(data).hexdigest()}
    made_of |= {"master": bundle.graph.master}
    if bundle.wiring and (digests := code_digests(bundle.wiring)):
        made_of |= {"drivers": digests}
    files = {
        "mind.bundle": data,  # never by its own name: no text of a user becomes a path on the robot
        "release.json": json.dumps(made_of).encode(),  # in ASCII, on one line
        SERVICE: unit().encode(),
        ARMED: unit(arm=True).encode(),
        **dict(_runtime()),
    }
    sums = "".join(f"{sha256(content).hexdigest()}  {name}\n" for name, content in sorted(files.items())).encode()
    for name, content in {**files, "SHA256SUMS": sums}.items():
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
    return Release(folder, sha256(sums).hexdigest(), sum(map(len, files.values())))


def unit(arm: bool = False) -> str:
    """The service that runs the current release, for the systemd of the robot's user: it needs no root, no password.

    Armed, the mind moves what is wired to it, and however it ends everything goes to neutral.
    """
    run = f"{PYTHON} -m mindrun mind.bundle" + " --arm" * arm
    neutral = f"ExecStopPost={PYTHON} -P -m mindrun.robot.guardian --neutral mind.bundle\n" * arm
    return UNIT.format(state="armed" if arm else "not armed", run=run, neutral=neutral)


def _runtime() -> Iterator[tuple[str, bytes]]:
    """The files of the mindrun that runs here, so that the robot has the very one that knows this bundle."""
    root = Path(mindrun.__path__[0])
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if path.is_file() and parts[0] != WORKSTATION and "__pycache__" not in parts:
            yield "/".join(("runtime", "mindrun", *parts)), path.read_bytes()
