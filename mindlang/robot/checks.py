"""What must be right here before a robot is asked anything."""

from __future__ import annotations

import re
import shutil
from typing import TYPE_CHECKING

from mindrun.errors import ProcedureError
from mindrun.graph.weights import reachable
from mindrun.kinds.procedure_text import fit, module_of

from mindlang.robot import DeployError

if TYPE_CHECKING:
    from mindrun.graph.bundle import Bundle

HOST = re.compile(r"(?:[A-Za-z0-9_][\w.-]*@)?[A-Za-z0-9_][\w.-]*", re.ASCII)


def check_host(host: str) -> None:
    """Refuse what ssh or rsync could take for an option, a path, or a command."""
    if not HOST.fullmatch(host):
        raise DeployError(
            f"{host!r} is not a host: write it as pi@robot.local.",
            "A port, an address with colons or a key belong under a Host in ~/.ssh/config.",
        )


def check_tools() -> None:
    """Refuse to begin without the two programs that do the work."""
    for tool, package in (("ssh", "openssh-client"), ("rsync", "rsync")):
        if shutil.which(tool) is None:
            raise DeployError(f"{tool} is not installed here.", f"sudo apt install {package}")


def check_wired(bundle: Bundle) -> None:
    """Refuse a service for a mind that does not say what is wired to what: it could neither sense nor act."""
    if getattr(bundle, "wiring", None) is None:
        raise DeployError(
            "This bundle does not say how the robot is wired, so no service can run it.",
            "Build it with its robot.yaml, or use --no-service to bring it there all the same.",
        )


def check_procedures(bundle: Bundle) -> None:
    """Refuse procedures of which the text says that they could not run."""
    for skill in reachable(bundle.graph, bundle.graph.master):
        if (calls := skill.function.calls) is not None:
            try:
                source = bundle.procedures.get(module_of(calls), "")
                fit(calls, source, len(skill.inputs), skill.outputs)
            except ProcedureError as error:
                raise DeployError(f"{error}.", error.hint or "Mend it, and build the bundle anew.") from error
