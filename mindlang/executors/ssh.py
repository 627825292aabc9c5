"""Other machines by ssh: Dask's scheduler on the first and a worker on each, begun by `distributed.SSHCluster`.

What they say to each other is encrypted, with a certificate for these workers alone that ssh brings there.
"""

import asyncio
import secrets
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from mindrun.errors import MindError

from mindlang.executors.jobs import Assignment, JobExecutor, WorkError

if TYPE_CHECKING:
    from distributed.security import Security

USAGE = "ssh:HOST[,HOST]…, with :/path/of/python behind a HOST where it is another than here"
CONNECT_SECONDS = 30.0
CHECK_SECONDS = 120.0  # to import mindlang there
# A machine that is gone is noticed within a minute.
OPTIONS: dict[str, Any] = {"keepalive_interval": 15, "keepalive_count_max": 3, "connect_timeout": CONNECT_SECONDS}
TLS_ROLES = ("client", "scheduler", "worker")
SCHEDULER_OPTIONS = {"port": 0, "protocol": "tls://", "dashboard": False, "idle_timeout": "10 minutes"}
WORKER_OPTIONS = {"protocol": "tls://", "death_timeout": 60}  # both end where nobody is left who gives jobs


@dataclass(frozen=True, slots=True)
class Machine:
    """A machine by the name that ssh knows, the user there (else as ssh says), and the path of Python there."""

    host: str
    user: str = ""
    python: str = sys.executable

    @property
    def options(self) -> dict[str, Any]:
        """How asyncssh connects to it; ports, keys and other names are read in ~/.ssh/config."""
        return {**OPTIONS, "username": self.user} if self.user else OPTIONS


def machines(argument: str) -> list[Machine]:
    """The machines of a list."""
    found = []
    for each in argument.split(","):
        where, _, python = each.partition(":")
        user, _, host = where.rpartition("@")
        found.append(Machine(host, user, python or sys.executable))
    return found


def flaw(argument: str) -> str:
    """What is wrong with a list of machines; nothing where nothing is. MindError where Dask or asyncssh is missing."""
    missing = [name for name in ("distributed", "asyncssh") if find_spec(name) is None]
    if missing:
        raise MindError(
            f"machines are reached with {missing[0]}, which is not installed", "pip install 'mindlang[cluster]'"
        )
    names = argument.split(",")
    if not all(machine.host for machine in machines(argument)):
        return "a machine has no name"
    wrong = next((name for name in names if name.startswith("-") or not name.isprintable() or " " in name), "")
    return f"{wrong!r:.40} is no machine" if wrong else ""


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """A worker on each machine that can be reached; WorkError where none can."""
    import dask.config
    from distributed import SSHCluster
    from distributed.security import Security

    from mindlang.executors.cluster_jobs import ClusterJobs
    from mindlang.executors.connection import client_of, silence

    silence()
    security, name = Security.temporary(), f".mindc-{secrets.token_hex(8)}.pem"
    there = asyncio.run(prepared(machines(argument), name, certificate_of(security), say))
    # Else a worker that is lost again within 15 s is given up for ever, nanny and all.
    dask.config.set({"distributed.deploy.lost-worker-timeout": "1h"})
    try:
        with dask.config.set(tls_config(name)):  # which goes there
            cluster = SSHCluster(**arguments(there), security=security)
    except Exception as error:
        said = f"{error.__cause__ or error}"
        raise WorkError(
            f"no cluster begins at {there[0].host}: {said}", "the machines have to reach each other"
        ) from error

    def end() -> None:
        with suppress(Exception):  # of machines that are gone, too
            cluster.close(timeout=CONNECT_SECONDS)
        asyncio.run(told(there, f"rm -f {name}"))

    try:
        client = client_of(cluster.scheduler_address, security)
    except BaseException:
        end()
        raise
    return ClusterJobs(client, assignment, say, ended=end)


def arguments(there: Sequence[Machine]) -> dict[str, Any]:
    """What SSHCluster is told of machines: the first, which has the scheduler, comes twice."""
    all_of_them = [there[0], *there]
    return {
        "hosts": [each.host for each in all_of_them],
        "connect_options": [each.options for each in all_of_them],
        "remote_python": [each.python for each in all_of_them],
        "scheduler_options": SCHEDULER_OPTIONS,
        "worker_options": WORKER_OPTIONS,
    }


def tls_config(name: str) -> dict[str, Any]:
    """Dask's configuration there: nobody is talked to but with the certificate in that file of the home folder."""
    roles = {f"distributed.comm.tls.{who}.{what}": name for who in TLS_ROLES for what in ("cert", "key")}
    return {**roles, "distributed.comm.tls.ca-file": name, "distributed.comm.require-encryption": True}


def certificate_of(security: "Security") -> str:
    """A certificate and its key."""
    return f"{security.tls_ca_file}{security.tls_client_key}"


async def prepared(
    asked: Sequence[Machine], name: str, certificate: str, say: Callable[[str], object]
) -> list[Machine]:
    """The machines that have mindlang, and now the certificate; WorkError where there are none."""
    found = await asyncio.gather(*(_flaw_of(each, name, certificate) for each in asked))
    for machine, why in zip(asked, found, strict=True):
        if why and not all(found):
            say(f"{machine.host} takes no part: {why}")
    if all(found):
        message = f"no machine takes part; the last, {asked[-1].host}: {found[-1]}"
        raise WorkError(
            message, f"see that this says nothing: ssh {asked[-1].host} {asked[-1].python} -c 'import mindlang'"
        )
    return [machine for machine, why in zip(asked, found, strict=True) if not why]


async def told(there: Sequence[Machine], command: str) -> None:
    """Have a command run on machines, as far as they can be reached."""
    await asyncio.gather(*(_run(each, command) for each in there), return_exceptions=True)


async def _flaw_of(machine: Machine, name: str, certificate: str) -> str:
    """Why a machine takes no part; nothing where it does."""
    import asyncssh

    command = f"umask 077 && cat > {name} && {machine.python} -c 'import mindlang.executors.cluster_jobs'"
    try:
        done = await _run(machine, command, certificate)
    except (OSError, asyncssh.Error, TimeoutError) as error:
        return f"{error}" or type(error).__name__
    if done.exit_status == 0:
        return ""
    return (f"{done.stderr}".strip().splitlines() or [f"exit code {done.exit_status}"])[-1]


async def _run(machine: Machine, command: str, given: str = "") -> Any:
    import asyncssh

    async with asyncssh.connect(machine.host, **machine.options) as connection:
        return await connection.run(command, input=given, timeout=CHECK_SECONDS)
