"""What is on a robot: its releases, which of them is current, and what it lacks."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from mindlang.deploying.errors import DeployError
from mindlang.deploying.robot import Event, Robot

MOMENT = "%Y%m%dT%H%M%SZ"
SYSTEMD = "systemctl --user"


@dataclass(frozen=True, slots=True)
class Deployed:
    """A release on the robot; `state` is whole, damaged, left (for an older one) or unused (never current)."""

    name: str
    state: str
    made_of: dict[str, object]


@dataclass(frozen=True, slots=True)
class State:
    """What `look` told, oldest release first."""

    current: str
    releases: tuple[Deployed, ...]
    lacks: tuple[str, ...]

    def has(self, fingerprint: str) -> bool:
        """Whether the current release is this one, and whole."""
        current = [each for each in self.releases if each.name == self.current and each.state == "whole"]
        return any(each.name.endswith(f"-{fingerprint[:8]}") for each in current)

    def before(self) -> str:
        """The release to go back to: the newest whole one that is older than the current one."""
        older = [each.name for each in self.releases if each.name < self.current and each.state == "whole"]
        if not older:
            raise DeployError("There is no whole release before the current one.", "mindc deploy HOST --list")
        return older[-1]

    def moment(self, now: datetime) -> str:
        """A time for a new release, later than those there: the clocks of two workstations differ."""
        newest = max((each.name.partition("-")[0] for each in self.releases), default="")
        moment = now.astimezone(UTC).strftime(MOMENT)
        if moment > newest:
            return moment
        return (datetime.strptime(newest, MOMENT) + timedelta(seconds=1)).strftime(MOMENT)


def look(robot: Robot) -> State:
    """Look at a robot, and change nothing there."""
    return state_of(robot.ask("look"))


def state_of(told: Sequence[Event]) -> State:
    """The state that the robot told."""
    releases = []
    for name, state, made_of in (detail.split(" ", 2) for event, detail in told if event == "release"):
        releases.append(Deployed(name, state, _parsed(made_of)))
    current = "".join(detail for event, detail in told if event == "current")
    lacks = tuple(detail for event, detail in told if event == "lacks")
    return State(current, tuple(sorted(releases, key=lambda each: each.name)), lacks)


def check_able(state: State, with_service: bool) -> None:
    """Refuse a robot that lacks what a deployment needs."""
    missing = [tool for tool in state.lacks if tool != SYSTEMD]
    if missing:
        raise DeployError(
            f"The robot lacks {', '.join(missing)}.", "sudo apt install rsync python3 coreutils util-linux"
        )
    if with_service and SYSTEMD in state.lacks:
        raise DeployError("The robot has no systemd for its user.", "--no-service deploys without a service.")


def _parsed(text: str) -> dict[str, object]:
    try:
        value = json.loads(text)
    except ValueError:
        return {}
    return value if isinstance(value, dict) else {}
