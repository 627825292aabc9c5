"""Which wiring this robot has: a bundle that was built for another one moves nothing here.

A file of the robot's own says it in one line, which `mindrun adopt` writes: its name and the SHA-256 of its wiring.
"""

import os
from pathlib import Path

from mindrun.bundle import fingerprint
from mindrun.durable import write
from mindrun.errors import MindError
from mindrun.robot.wiring import Wiring


class IdentityError(MindError):
    """A bundle for another robot, or a robot that has not said which it is."""


def identity_file() -> Path:
    """Where the robot says it: `MIND_ROBOT`, or in the user's configuration."""
    given = os.environ.get("MIND_ROBOT")
    return Path(given) if given else Path.home() / ".config" / "mind" / "robot"


def adopt(wiring: Wiring) -> Path:
    """This robot is wired so from now on; the file that says it."""
    path = identity_file()
    path.parent.mkdir(parents=True, exist_ok=True)
    write(path, f"{wiring.robot} {fingerprint(wiring)}\n".encode())
    return path


def refuse_another(wiring: Wiring, bundle: Path) -> None:
    """IdentityError unless this robot has adopted just this wiring."""
    path = identity_file()
    remedy = f"if it really is wired so: mindrun adopt {bundle}"
    try:
        name, _, known = path.read_text(encoding="utf-8").strip().rpartition(" ")
    except FileNotFoundError:
        raise IdentityError("nothing may move yet: this robot has not said how it is wired", remedy) from None
    except (OSError, UnicodeDecodeError) as error:
        raise IdentityError(f"{path} cannot be read: {error}", remedy) from error
    if known != fingerprint(wiring):
        raise IdentityError(
            f"this bundle is wired for {wiring.robot}, otherwise than {name or 'this robot'} is", remedy
        )
