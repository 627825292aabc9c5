"""A deployment from the first look to the last: every step may be the last one, and may be done again."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from mindrun.graph.bundle import Bundle

from mindlang.robot.release import Release, make_release
from mindlang.robot.remote import RemoteRobot, RobotEvent
from mindlang.robot.remote_state import ReleaseState, check_able, read_state
from mindlang.robot.unit import ARMED, SERVICE

Tell = Callable[[str], None]


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

    def words(self, release: str, left: str = "") -> list[str]:
        """The words of the verb `switch`."""
        return [release, self.unit, str(self.keep), str(self.watch), "yes" if self.go_back else "no", left]


@dataclass(frozen=True, slots=True)
class DeployResult:
    """The result of a deployment: the current release, the one before, and remarks."""

    release: str
    before: str
    notes: tuple[str, ...] = ()


def deploy(
    robot: RemoteRobot,
    path: Path,
    bundle: Bundle,
    settings: Settings,
    now: datetime,
    tell: Tell,
    try_only: bool = False,
) -> DeployResult:
    """Bring a bundle to a robot; with `try_only` say only what would be done."""
    with tempfile.TemporaryDirectory(prefix="mind-release-") as folder, _alone(robot, settings, tell, try_only):
        release = make_release(path, bundle, Path(folder))
        state = _looked(robot, tell)
        if state.has(release.fingerprint):
            name = state.current
            tell(f"{robot.host} has this release already: {name}")
        else:
            name = release.named(state.moment(now))
            tell(f"{_would(try_only)}copy {release.size / 1024:,.0f} KiB to {robot.host} as {name}")
            if not try_only:
                _bring(robot, release, name, tell)
        return _switch(robot, state, name, settings, tell, try_only)


def roll_back(robot: RemoteRobot, settings: Settings, tell: Tell, try_only: bool = False) -> DeployResult:
    """Go back to the release before the current one, which is then left for good."""
    with _alone(robot, settings, tell, try_only):
        state = _looked(robot, tell)
        return _switch(robot, state, state.before(), settings, tell, try_only, left=state.current)


def _alone(robot: RemoteRobot, settings: Settings, tell: Tell, try_only: bool) -> AbstractContextManager[None]:
    """A robot that can do it, and no other deployment to it meanwhile; who changes nothing there need not wait."""
    check_able(read_state(robot), settings.service)
    if try_only:
        return nullcontext()
    return robot.locked(lambda: tell("another deployment to this robot is under way: waiting for up to a minute"))


def _looked(robot: RemoteRobot, tell: Tell) -> ReleaseState:
    """The state of a robot; what somebody has deleted there is told."""
    state = read_state(robot)
    if state.is_gone():
        tell(f"the current release, {state.current}, has been deleted on {robot.host}")
    return state


def _bring(robot: RemoteRobot, release: Release, name: str, tell: Tell) -> None:
    for _, detail in robot.ask("prepare"):
        tell(detail)
    robot.copy(release.folder, f"mind/incoming/{release.fingerprint}")
    robot.ask("accept", release.fingerprint, name)
    tell("it has arrived whole, and the robot can read it")


def _switch(
    robot: RemoteRobot, state: ReleaseState, name: str, settings: Settings, tell: Tell, try_only: bool, left: str = ""
) -> DeployResult:
    before = state.current
    tell(f"{_would(try_only)}switch from {before or 'nothing'} to {name}, {_manner(settings)}")
    if try_only:
        return DeployResult(before, before)
    told = robot.ask("switch", *settings.words(name, left))
    return DeployResult(name, before, tuple(note for event in told if (note := _note(event))))


def _manner(settings: Settings) -> str:
    match settings.unit:
        case "none":
            return "without a service"
        case unit if unit == ARMED:
            return "with an armed service"
        case _:
            return "with a service that is not armed"


def _note(event: RobotEvent) -> str:
    match event:
        case "unlingering", user:
            return f"the service waits for a login: on the robot, sudo loginctl enable-linger {user}"
        case _:
            return ""


def _would(try_only: bool) -> str:
    return "would " if try_only else ""
