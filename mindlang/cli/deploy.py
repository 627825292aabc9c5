"""`mindc deploy`: a bundle brought to a robot, and back to the one before.

Examples:
  mindc deploy ball.bundle pi@robot.local
  mindc deploy ball.bundle pi@robot.local --arm-service
  mindc deploy ball.bundle pi@robot.local --dry-run
  mindc deploy pi@robot.local --list
  mindc deploy pi@robot.local --rollback
"""

from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from mindrun.errors import BundleError
from mindrun.files.printable import visible

from mindlang.cli._options import flag, json_flag, quiet_flag, unless
from mindlang.cli._terminal import INTERRUPTED, MISUSE, fail, is_asked, print_json, refusing, tell

if TYPE_CHECKING:
    from mindrun.graph.bundle import Bundle

    from mindlang.robot.deployment import DeployResult, ReleaseState, Settings
    from mindlang.robot.remote import RemoteRobot


@click.command
@click.argument("words", nargs=-1, required=True, metavar="[BUNDLE] HOST")
@flag("--rollback", "Go back to the release before: --rollback")
@flag("--list as_list", "Show the releases that are there: --list")
@flag("--arm-service armed", "The service moves the robot, at every start: --arm-service")
@unless("--no-service service", "No service runs it, an older one is removed: --no-service")
@click.option("--keep", type=click.IntRange(2, 1000), default=3, show_default=True, help="Releases that stay: --keep 5")
@click.option(
    "--watch", type=click.IntRange(0, 60), default=5, show_default=True, help="Seconds to see it run: --watch 10"
)
@unless("--no-auto-rollback go_back", "Stay with a release that does not run: --no-auto-rollback")
@flag("--dry-run", "Say what would be done, and do nothing: --dry-run")
@json_flag("Say what came of it as one JSON document: --json")
@quiet_flag("Print nothing but errors: -q")
def command(words: tuple[str, ...], rollback: bool, as_list: bool, dry_run: bool, **said: Any) -> None:
    """Bring BUNDLE to HOST over ssh, and start it as a service.

    It is copied with rsync, verified there, and made current in one step. The service is not armed, that is it moves
    nothing, unless this very command says --arm-service. A release whose service does not stay up is left again for the
    one before. Interrupted at any moment, the robot has the old release or the new one, whole; the same command goes
    on.
    """
    from mindlang.robot.deployment import Deployment, Settings
    from mindlang.robot.remote import check_host, check_tools, connected

    *bundles, host = words
    if len(bundles) > 1 or not (bundles or rollback or as_list):
        raise click.UsageError("Write mindc deploy BUNDLE HOST, or mindc deploy HOST with --rollback or --list.")
    path = Path(bundles[0]) if bundles and not (rollback or as_list) else None
    settings = Settings(**said)
    if (rollback and as_list) or (settings.armed and not settings.service):
        raise click.UsageError("--rollback and --list, like --arm-service and --no-service, exclude each other.")
    try:
        with refusing():
            check_host(host)
            bundle = _checked(path, settings) if path else None
            check_tools()
            with connected(host) as robot:
                if as_list:
                    _list(robot)
                    return
                deployment = Deployment(robot, settings, _report, dry_run)
                done = deployment.deploy(path, bundle, datetime.now(UTC)) if path and bundle else deployment.roll_back()
    except KeyboardInterrupt:
        whole = "Interrupted: the robot has the old release or the new one, whole."
        fail(whole, "The same command goes on.", INTERRUPTED)
    tell(*(f"note: {note}" for note in done.notes))
    if is_asked("as_json"):
        print_json(_result(host, done, settings, dry_run))
    elif not dry_run:
        _report(f"{host} has {done.release}")


def _report(message: str) -> None:
    if not is_asked("quiet"):
        click.echo(message, err=True)


def _result(host: str, done: "DeployResult", settings: "Settings", dry_run: bool) -> dict[str, object]:
    """The outcome of a deployment as one JSON document."""
    service = {"unit": "mind.service", "armed": settings.armed} if settings.service else None
    said = {"host": host, "dry_run": dry_run, "release": done.release or None, "before": done.before or None}
    return {**said, "service": service, "notes": list(done.notes)}


def _checked(path: Path, settings: "Settings") -> "Bundle":
    """The bundle; one that cannot be read ends the program."""
    from mindrun.graph.bundle import read_bundle

    from mindlang.robot.deployment import check_deployable

    try:
        bundle = read_bundle(path)
    except BundleError as error:
        fail(str(error), error.hint or "mindc build writes one.", MISUSE)
    check_deployable(bundle, settings.service)
    return bundle


def _list(robot: "RemoteRobot") -> None:
    from mindlang.robot.deployment import read_state

    state = read_state(robot)
    if is_asked("as_json"):
        print_json(_listed(state))
        return
    for each in state.releases:
        mark = "→" if each.name == state.current else " "
        made_of = f"{each.made_of.get('bundle', '?')}, {each.made_of.get('master', '?')} in charge"
        click.echo(f"{mark} {each.name}  {each.state:8}{visible(made_of)}")
    if not state.releases:
        click.echo("nothing has been deployed there", err=True)


def _listed(state: "ReleaseState") -> dict[str, object]:
    releases = [{"release": each.name, "state": each.state, **each.made_of} for each in state.releases]
    return {"current": state.current or None, "releases": releases}
