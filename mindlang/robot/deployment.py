"""A deployment from the first look to the last: every step may be the last one, and may be done again."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path

from mindrun.files.strict_json import parsed
from mindrun.graph.bundle import Bundle

from mindlang.robot import DeployError
from mindlang.robot.release import ARMED, SERVICE, make_release
from mindlang.robot.remote import RemoteRobot, RobotEvent

MOMENT = "%Y%m%dT%H%M%SZ"
RELEASE = re.compile(r"(\d{8}T\d{6}Z)-[0-9a-f]{8}", re.ASCII)
LAST_YEAR = 9999  # after which no release could be named
RELEASE_LINE = re.compile(r"(?P<name>\S+) (?P<state>\S+) (?P<made_of>.*)")
SYSTEMD = "systemctl --user"
MADE_OF = "bundle", "sha256", "master"
MANNERS = {
    "none": "without a service",
    ARMED: "with an armed service",
    SERVICE: "with a service that is not armed",
}


@dataclass(frozen=True, slots=True)
class Deployed:
    """A release on the robot; `state` is whole, damaged, left (for an older one) or unused (never current)."""

    name: str
    state: str
    made_of: dict[str, str]


@dataclass(frozen=True, slots=True)
class ReleaseState:
    """What is on a robot: its releases, oldest first, which of them is current, and what it lacks."""

    current: str
    releases: tuple[Deployed, ...]
    lacks: tuple[str, ...]

    def has(self, fingerprint: str) -> bool:
        """Whether the current release is this one, and whole."""
        return self.current.endswith(f"-{fingerprint[:8]}") and self.current in self._whole

    def before(self) -> str:
        """The release to go back to: the newest whole one that is older than the current one."""
        if older := [name for name in self._whole if name < self.current]:
            return older[-1]
        raise DeployError("There is no whole release before the current one.", "mindc deploy HOST --list")

    def is_gone(self) -> bool:
        """Whether somebody has deleted the current release on the robot."""
        return bool(self.current) and self.current not in {each.name for each in self.releases}

    def moment(self, now: datetime) -> str:
        """A time for a new release, later than those there: the clocks of two workstations differ."""
        names = [self.current, *(each.name for each in self.releases)]
        known = [moment + timedelta(seconds=1) for name in names if (moment := moment_of(name))]
        return max([now.astimezone(UTC), *known]).strftime(MOMENT)

    @property
    def _whole(self) -> list[str]:
        return [each.name for each in self.releases if each.state == "whole"]


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


def _made_of(text: str) -> dict[str, str]:
    """What a release says of itself; nothing where it does not say it as it was written."""
    try:
        said = parsed(text)
    except ValueError:
        return {}
    return {word: said[word] for word in MADE_OF if isinstance(said, dict) and isinstance(said.get(word), str)}


@dataclass(frozen=True, slots=True)
class Settings:
    """How a release is run: by a service, armed or not, or by none; watched for some seconds at its start."""

    service: bool = True
    armed: bool = False
    keep: int = 3
    watch: int = 5
    go_back: bool = True

    @property
    def unit(self) -> str:
        """The file of the release that becomes the service, or none."""
        return (ARMED if self.armed else SERVICE) if self.service else "none"


@dataclass(frozen=True, slots=True)
class DeployResult:
    """The result of a deployment: the current release, the one before, and remarks."""

    release: str
    before: str
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Deployment:
    """A robot, how a release is to run there, and whom to tell; with `try_only` it is told only what would be done."""

    robot: RemoteRobot
    settings: Settings
    tell: Callable[[str], None]
    try_only: bool = False

    def deploy(self, path: Path, bundle: Bundle, now: datetime) -> DeployResult:
        """Bring a bundle to the robot."""
        with tempfile.TemporaryDirectory(prefix="mind-release-") as folder, self._alone():
            release = make_release(path, bundle, Path(folder))
            state = self._looked()
            if state.has(release.fingerprint):
                self.tell(f"{self.robot.host} has this release already: {state.current}")
                return self._switch(state, state.current)
            name = release.named(state.moment(now))
            self._tell_of(f"copy {release.size / 1024:,.0f} KiB to {self.robot.host} as {name}")
            if not self.try_only:
                for _, detail in self.robot.ask("prepare"):
                    self.tell(detail)
                self.robot.copy(release.folder, f"mind/incoming/{release.fingerprint}")
                self.robot.ask("accept", release.fingerprint, name)
                self.tell("it has arrived whole, and the robot can read it")
            return self._switch(state, name)

    def roll_back(self) -> DeployResult:
        """Go back to the release before the current one, which is then left for good."""
        with self._alone():
            state = self._looked()
            return self._switch(state, state.before(), left=state.current)

    def _alone(self) -> AbstractContextManager[None]:
        """A robot that can do it, and no other deployment to it meanwhile; who changes nothing there need not wait."""
        lacks = read_state(self.robot).lacks
        if missing := [tool for tool in lacks if tool != SYSTEMD]:
            hint = "sudo apt install rsync python3 coreutils util-linux"
            raise DeployError(f"The robot lacks {', '.join(missing)}.", hint)
        if self.settings.service and SYSTEMD in lacks:
            raise DeployError("The robot has no systemd for its user.", "--no-service deploys without a service.")
        if self.try_only:
            return nullcontext()
        waiting = "another deployment to this robot is under way: waiting for up to a minute"
        return self.robot.locked(lambda: self.tell(waiting))

    def _looked(self) -> ReleaseState:
        """The state of the robot; what somebody has deleted there is told."""
        state = read_state(self.robot)
        if state.is_gone():
            self.tell(f"the current release, {state.current}, has been deleted on {self.robot.host}")
        return state

    def _switch(self, state: ReleaseState, name: str, left: str = "") -> DeployResult:
        before, how = state.current, self.settings
        self._tell_of(f"switch from {before or 'nothing'} to {name}, {MANNERS[how.unit]}")
        if self.try_only:
            return DeployResult(before, before)
        told = self.robot.ask(
            "switch", name, how.unit, f"{how.keep}", f"{how.watch}", "yes" if how.go_back else "no", left
        )
        users = (user for event, user in told if event == "unlingering")
        notes = (f"the service waits for a login: on the robot, sudo loginctl enable-linger {user}" for user in users)
        return DeployResult(name, before, tuple(notes))

    def _tell_of(self, step: str) -> None:
        """Say what is done, or would be."""
        self.tell(f"{'would ' * self.try_only}{step}")
