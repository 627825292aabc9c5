"""Deploys a bundle to a robot. Every step may be the last one, and may be done again.

What is brought is a release: a folder with the bundle, the mindrun that reads it and its services. Its name stands for
every byte.
"""

import json
import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from hashlib import sha256
from importlib.resources import files
from pathlib import Path

import mindrun
from mindrun.errors import ProcedureError
from mindrun.files.regular_files import read_whole
from mindrun.files.strict_json import parsed
from mindrun.graph.bundle import MAX_BUNDLE_BYTES, Bundle
from mindrun.graph.weights import reachable
from mindrun.graph.wiring import code_digests
from mindrun.kinds.procedure_text import fit, module_of

from mindlang.robot import DeployError
from mindlang.robot.remote import RemoteRobot, RobotEvent

WORKSTATION = "sim"  # the room of mindrun that no robot has a use for
SERVICE, ARMED = "mind.service", "mind-armed.service"  # what they are called in a release
PYTHON = "%h/mind/venv/bin/python"
MOMENT = "%Y%m%dT%H%M%SZ"
RELEASE = re.compile(r"(\d{8}T\d{6}Z)-[0-9a-f]{8}", re.ASCII)
LAST_YEAR = 9999  # after which no release could be named
RELEASE_LINE = re.compile(r"(?P<name>\S+) (?P<state>\S+) (?P<made_of>.*)")
SYSTEMD = "systemctl --user"
MADE_OF = "bundle", "sha256", "master"
MANNERS = {"none": "without a service", ARMED: "with an armed service", SERVICE: "with a service that is not armed"}


@dataclass(frozen=True, slots=True)
class Release:
    """A release that lies in a folder here: `fingerprint` is the SHA-256 of its SHA256SUMS."""

    folder: Path
    fingerprint: str
    size: int


def check_deployable(bundle: Bundle, with_service: bool) -> None:
    """Refuse procedures of which the text says that they could not run, and a service that would have no wiring."""
    for skill in reachable(bundle.graph, bundle.graph.master):
        if (calls := skill.function.calls) is not None:
            try:
                text = str(bundle.procedures.get(module_of(calls), ""))
                fit(calls, text, len(skill.inputs), skill.outputs, bool(skill.files))
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
    contents = {
        "mind.bundle": data,  # never by its own name: no text of a user becomes a path on the robot
        "release.json": json.dumps(made_of).encode(),  # in ASCII, on one line
        SERVICE: unit().encode(),
        ARMED: unit(arm=True).encode(),
        **dict(_runtime()),
    }
    sums = "".join(f"{sha256(content).hexdigest()}  {name}\n" for name, content in sorted(contents.items())).encode()
    for name, content in {**contents, "SHA256SUMS": sums}.items():
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
    return Release(folder, sha256(sums).hexdigest(), sum(map(len, contents.values())))


def unit(arm: bool = False) -> str:
    """The service that runs the current release, for the systemd of the robot's user: it needs no root, no password.

    Armed, the mind moves what is wired to it, and however it ends everything goes to neutral.
    """
    run = f"{PYTHON} -m mindrun mind.bundle" + " --arm" * arm
    neutral = f"ExecStopPost={PYTHON} -P -m mindrun.robot.guardian --neutral mind.bundle\n" * arm
    template = (files("mindlang.robot") / SERVICE).read_text("utf-8")
    return template.format(state="armed" if arm else "not armed", run=run, neutral=neutral)


def _runtime() -> Iterator[tuple[str, bytes]]:
    """The files of the mindrun that runs here, so that the robot has the very one that knows this bundle."""
    root = Path(mindrun.__path__[0])
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if path.is_file() and parts[0] != WORKSTATION and "__pycache__" not in parts:
            yield "/".join(("runtime", "mindrun", *parts)), path.read_bytes()


@dataclass(frozen=True, slots=True)
class Deployed:
    """A release on the robot; `state` is whole, damaged, left (for an older one) or unused (never current)."""

    name: str
    state: str
    made_of: dict[str, str]


@dataclass(frozen=True, slots=True)
class ReleaseState:
    """The state of a robot: its releases, oldest first, which of them is current, and what it lacks."""

    current: str
    releases: tuple[Deployed, ...]
    lacks: tuple[str, ...]

    def has(self, fingerprint: str) -> bool:
        """True if the current release is this one, and whole."""
        return self.current.endswith(f"-{fingerprint[:8]}") and self.current in self._whole

    def before(self) -> str:
        """The release to go back to: the newest whole one that is older than the current one."""
        if older := [name for name in self._whole if name < self.current]:
            return older[-1]
        raise DeployError("There is no whole release before the current one.", "mindc deploy HOST --list")

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
    """Ask a robot for its state; changes nothing there."""
    return parse_state(robot.run_verb("look"))


def parse_state(told: Sequence[RobotEvent]) -> ReleaseState:
    """The state of a robot from the events of `robot.sh look`."""
    found = (RELEASE_LINE.fullmatch(detail) for event, detail in told if event == "release")
    releases = []
    for each in (each for each in found if each and moment_of(each["name"])):
        try:
            said = parsed(each["made_of"])
        except ValueError:  # it does not say what it is as that was written
            said = None
        told_of = said.items() if isinstance(said, dict) else ()
        made_of = {word: value for word, value in told_of if word in MADE_OF and isinstance(value, str)}
        releases.append(Deployed(each["name"], each["state"], made_of))
    named = "".join(detail for event, detail in told if event == "current")
    current = named if moment_of(named) else ""
    lacks = tuple(detail for event, detail in told if event == "lacks")
    return ReleaseState(current, tuple(sorted(releases, key=lambda each: each.name)), lacks)


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of a deployment: a service, armed or not, or none, and how many seconds its start is watched."""

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
            name = f"{state.moment(now)}-{release.fingerprint[:8]}"  # names sort by their age
            self._tell_of(f"copy {release.size / 1024:,.0f} KiB to {self.robot.host} as {name}")
            if not self.try_only:
                for _, detail in self.robot.run_verb("prepare"):
                    self.tell(detail)
                self.robot.copy(release.folder, f"mind/incoming/{release.fingerprint}")
                self.robot.run_verb("accept", release.fingerprint, name)
                self.tell("it has arrived whole, and the robot can read it")
            return self._switch(state, name)

    def roll_back(self) -> DeployResult:
        """Go back to the release before the current one, which is then left for good."""
        with self._alone():
            state = self._looked()
            return self._switch(state, state.before(), left=state.current)

    def _alone(self) -> AbstractContextManager[None]:
        """Hold the lock of a robot that has all that a deployment needs; a trial changes nothing, and takes no lock."""
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
        """The state of the robot; says so where its current release has been deleted."""
        state = read_state(self.robot)
        if state.current and state.current not in {each.name for each in state.releases}:
            self.tell(f"the current release, {state.current}, has been deleted on {self.robot.host}")
        return state

    def _switch(self, state: ReleaseState, name: str, left: str = "") -> DeployResult:
        before, how = state.current, self.settings
        self._tell_of(f"switch from {before or 'nothing'} to {name}, {MANNERS[how.unit]}")
        if self.try_only:
            return DeployResult(before, before)
        told = self.robot.run_verb(
            "switch", name, how.unit, f"{how.keep}", f"{how.watch}", "yes" if how.go_back else "no", left
        )
        users = (user for event, user in told if event == "unlingering")
        notes = (f"the service waits for a login: on the robot, sudo loginctl enable-linger {user}" for user in users)
        return DeployResult(name, before, tuple(notes))

    def _tell_of(self, step: str) -> None:
        """Say what is done, or would be."""
        self.tell(f"{'would ' * self.try_only}{step}")
