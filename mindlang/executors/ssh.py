"""Other machines by ssh: Dask's scheduler on the first and a worker on each, begun by `distributed.SSHCluster`.

What they say to each other is encrypted, with a certificate for these workers alone that ssh brings there.
"""

import asyncio
import secrets
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

from mindlang.executors.jobs import Assignment, JobExecutor, WorkError, refuse_without

USAGE = "ssh:HOST[,HOST]…, with :/path/of/python behind a HOST where it is another than here"
CONNECT_SECONDS = 30.0
CHECK_SECONDS = 120.0  # to import mindlang there
# A machine that is gone is noticed within a minute.
OPTIONS: dict[str, Any] = {"keepalive_interval": 15, "keepalive_count_max": 3, "connect_timeout": CONNECT_SECONDS}
TLS_FILES = [f"{who}.{what}" for who in ("client", "scheduler", "worker") for what in ("cert", "key")] + ["ca-file"]
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
        """The options with which asyncssh connects to it; ports, keys and other names are read in ~/.ssh/config."""
        return {**OPTIONS, "username": self.user} if self.user else OPTIONS

    async def run(self, command: str, given: str = "") -> Any:
        import asyncssh

        async with asyncssh.connect(self.host, **self.options) as connection:
            return await connection.run(command, input=given, timeout=CHECK_SECONDS)

    async def flaw(self, name: str, certificate: str) -> str:
        """Why it takes no part; nothing where it does, and has the certificate now."""
        import asyncssh

        command = f"umask 077 && cat > {name} && {self.python} -c 'import mindlang.executors.cluster_jobs'"
        try:
            done = await self.run(command, certificate)
            if done.exit_status == 0:
                return ""
            await self.run(f"rm -f {name}")
        except (OSError, asyncssh.Error, TimeoutError) as error:
            return f"{error}" or type(error).__name__
        return (f"{done.stderr}".strip().splitlines() or [f"exit code {done.exit_status}"])[-1]


def machines(argument: str) -> list[Machine]:
    found = []
    for each in argument.split(","):
        where, _, python = each.partition(":")
        user, _, host = where.rpartition("@")
        found.append(Machine(host, user, python or sys.executable))
    return found


def flaw(argument: str) -> str:
    """The flaw of a list of machines; "" where it has none. MindError where Dask or asyncssh is missing."""
    refuse_without(("distributed", "asyncssh"), "machines are reached with", "cluster")
    if not all(machine.host for machine in machines(argument)):
        return "a machine has no name"
    names = argument.split(",")
    wrong = next((name for name in names if name.startswith("-") or not name.isprintable() or " " in name), "")
    return f"{wrong!r:.40} is no machine" if wrong else ""


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """A worker on each machine that can be reached; WorkError where none can."""
    import dask.config
    from distributed import SSHCluster
    from distributed.security import Security

    from mindlang.executors.cluster_jobs import jobs_of_cluster, silence

    silence()
    security, name = Security.temporary(), f".mindc-{secrets.token_hex(8)}.pem"
    certificate = f"{security.tls_ca_file}{security.tls_client_key}"
    there = asyncio.run(_prepared(machines(argument), name, certificate, say))
    forget = partial(_told, there, f"rm -f {name}")
    # Else a worker that is lost again within 15 s is given up for ever, nanny and all.
    dask.config.set({"distributed.deploy.lost-worker-timeout": "1h"})
    # Nobody there is talked to but with the certificate in that file of the home folder.
    encrypted = {f"distributed.comm.tls.{file}": name for file in TLS_FILES}
    try:
        with dask.config.set({**encrypted, "distributed.comm.require-encryption": True}):  # which goes there
            cluster = SSHCluster(**arguments(there), security=security)
    except BaseException as error:
        asyncio.run(forget())
        if not isinstance(error, Exception):
            raise
        said = f"no cluster begins at {there[0].host}: {error.__cause__ or error}"
        raise WorkError(said, "the machines have to reach each other") from error

    def end() -> None:
        with suppress(Exception):  # of machines that are gone, too
            cluster.close(timeout=CONNECT_SECONDS)
        asyncio.run(forget())

    return jobs_of_cluster(cluster, security, assignment, say, end)


def arguments(there: Sequence[Machine]) -> dict[str, Any]:
    """The arguments of SSHCluster for machines: the first, which has the scheduler, comes twice."""
    all_of_them = [there[0], *there]
    return {
        "hosts": [each.host for each in all_of_them],
        "connect_options": [each.options for each in all_of_them],
        "remote_python": [each.python for each in all_of_them],
        "scheduler_options": SCHEDULER_OPTIONS,
        "worker_options": WORKER_OPTIONS,
    }


async def _prepared(
    asked: Sequence[Machine], name: str, certificate: str, say: Callable[[str], object]
) -> list[Machine]:
    """The machines that have mindlang, and now the certificate; WorkError where there are none."""
    found = await asyncio.gather(*(each.flaw(name, certificate) for each in asked))
    if all(found):
        last = asked[-1]
        message = f"no machine takes part; the last, {last.host}: {found[-1]}"
        raise WorkError(message, f"see that this says nothing: ssh {last.host} {last.python} -c 'import mindlang'")
    for machine, why in zip(asked, found, strict=True):
        if why:
            say(f"{machine.host} takes no part: {why}")
    return [machine for machine, why in zip(asked, found, strict=True) if not why]


async def _told(there: Sequence[Machine], command: str) -> None:
    """Have a command run on machines, as far as they can be reached."""
    await asyncio.gather(*(each.run(command) for each in there), return_exceptions=True)
