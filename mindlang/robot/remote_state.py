"""What is on a robot: its releases, which of them is current, and what it lacks."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from mindrun.files.strict_json import parsed

from mindlang.robot import DeployError
from mindlang.robot.remote import RemoteRobot, RobotEvent

MOMENT = "%Y%m%dT%H%M%SZ"
RELEASE = re.compile(r"(\d{8}T\d{6}Z)-[0-9a-f]{8}", re.ASCII)
LAST_YEAR = 9999  # after which no release could be named
RELEASE_LINE = re.compile(r"(?P<name>\S+) (?P<state>\S+) (?P<made_of>.*)")
SYSTEMD = "systemctl --user"
MADE_OF = "bundle", "sha256", "master"


@dataclass(frozen=True, slots=True)
class Deployed:
    """A release on the robot; `state` is whole, damaged, left (for an older one) or unused (never current)."""

    name: str
    state: str
    made_of: dict[str, str]


@dataclass(frozen=True, slots=True)
class ReleaseState:
    """What `read_state` told, oldest release first."""

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

    def is_gone(self) -> bool:
        """Whether somebody has deleted the current release on the robot."""
        return bool(self.current) and self.current not in {each.name for each in self.releases}

    def moment(self, now: datetime) -> str:
        """A time for a new release, later than those there: the clocks of two workstations differ."""
        names = [self.current, *(each.name for each in self.releases)]
        known = [moment + timedelta(seconds=1) for name in names if (moment := moment_of(name))]
        return max([now.astimezone(UTC), *known]).strftime(MOMENT)


def moment_of(release: str) -> datetime | None:
    """When a release was made, by its name; None where that is no name of a release, or of no time."""
    found = RELEASE.fullmatch(release)
    try:
        moment = datetime.strptime(found[1], MOMENT).replace(tzinfo=UTC) if found else None
    except ValueError:
        return None
    return moment if moment and moment.year < LAST_YEAR else None


def read_state(robot: RemoteRobot) -> ReleaseState:
    """The releases on a robot; changes nothing there."""
    return parse_state(robot.ask("look"))


def parse_state(told: Sequence[RobotEvent]) -> ReleaseState:
    """The state of a robot from the events of `robot.sh look`."""
    found = (RELEASE_LINE.fullmatch(detail) for event, detail in told if event == "release")
    releases = [
        Deployed(each["name"], each["state"], _made_of(each["made_of"]))
        for each in found
        if each and moment_of(each["name"])
    ]
    named = "".join(detail for event, detail in told if event == "current")
    current = named if moment_of(named) else ""
    lacks = tuple(detail for event, detail in told if event == "lacks")
    return ReleaseState(current, tuple(sorted(releases, key=lambda each: each.name)), lacks)


def check_able(state: ReleaseState, with_service: bool) -> None:
    """Refuse a robot that lacks what a deployment needs."""
    missing = [tool for tool in state.lacks if tool != SYSTEMD]
    if missing:
        raise DeployError(
            f"The robot lacks {', '.join(missing)}.", "sudo apt install rsync python3 coreutils util-linux"
        )
    if with_service and SYSTEMD in state.lacks:
        raise DeployError("The robot has no systemd for its user.", "--no-service deploys without a service.")


def _made_of(text: str) -> dict[str, str]:
    """What a release says of itself; nothing where it does not say it as it was written."""
    try:
        said = parsed(text)
    except ValueError:
        return {}
    if not isinstance(said, dict):
        return {}
    return {word: said[word] for word in MADE_OF if isinstance(said.get(word), str)}
