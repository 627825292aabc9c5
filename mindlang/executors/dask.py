"""The workers of a Dask cluster, by the address of its scheduler or by the file that it has written.

What goes there is encrypted, unless the way to it is this machine or a network that is trusted.
"""

import json
import re
import shlex
from collections.abc import Callable
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.files.regular_files import read_whole
from mindrun.terminal.command_line import command_line

from mindlang.executors.jobs import Assignment, JobExecutor, WorkError, refuse_without

if TYPE_CHECKING:
    from distributed import Client
    from distributed.security import Security

USAGE = "dask:scheduler.json or dask:tls://HOST:8786, with ,tls.pem or ,trusted"
TRUSTED = "trusted"  # the network is, and nothing has to be encrypted
MAX_FILE_BYTES = 1 << 24
MAX_PORT = 65535
ADDRESS = re.compile(r"(?:(?P<scheme>[a-z]+)://)?(?P<host>\[[0-9a-fA-F:.%]+\]|[\w.-]+):(?P<port>\d{1,5})/?")
TLS = 'TLS="--protocol tls --tls-ca-file tls.pem --tls-cert tls.pem --tls-key tls.pem"'


@dataclass(frozen=True, slots=True)
class Destination:
    """The argument of `dask:`: an address or a scheduler file, and how it is reached.

    `pem` is a file with a certificate and its key, which everybody in the cluster has; empty where Dask's own
    configuration says it. With `is_trusted` nothing needs to be encrypted.
    """

    place: str
    pem: str = ""
    is_trusted: bool = False

    def address(self) -> str:
        """The scheduler, as scheme://host:port; WorkError where no file says its address, or others could listen."""
        address = self.place if _parts(self.place) else _address_in(Path(self.place))
        self.refuse_open(address)
        return address if "://" in address else f"tcp://{address}"

    def refuse_open(self, address: str) -> None:
        """WorkError where others could read and write what goes to an address, unless the network is trusted."""
        scheme, host = _parts(address) or ("", "")
        if scheme == "tls" or self.is_trusted or _is_loopback(host):
            return
        raise WorkError(
            f"what goes to {address} is not encrypted, and whoever reaches that port can run code there",
            "begin scheduler and workers with tls (docs/cluster.md), or where nobody else is in the network: "
            f"--on dask:{self.place},{TRUSTED}",
        )


def sbatch(path: str) -> tuple[str, str]:
    """The two lines that begin a cluster with SLURM: a scheduler that writes this file, eight workers of 4 cores."""
    return (
        f'sbatch --wrap "dask scheduler --scheduler-file {path} $TLS"',
        f'sbatch --array 1-8 -c 4 --requeue --wrap "dask worker --scheduler-file {path} --nthreads 4 $TLS"',
    )


def destination(argument: str) -> Destination:
    place, _, how = argument.partition(",")
    return Destination(place, is_trusted=True) if how == TRUSTED else Destination(place, how)


def flaw_of(argument: str) -> str:
    """The flaw of an argument by itself; "" where it has none."""
    place = destination(argument).place
    if not place or argument.endswith(","):
        return "it says no scheduler"
    return f"{place!r:.60} is no address" if "://" in place and not _parts(place) else ""


def flaw(argument: str) -> str:
    """The flaw of an address; "" where it has none. MindError without Dask, or a way there that is safe."""
    refuse_without(("distributed",), "a cluster is reached with", "cluster")
    if not (found := flaw_of(argument)):
        destination(argument).address()
    return found


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """An executor on the workers that are connected to the scheduler, now or later."""
    from mindlang.executors.cluster_jobs import ClusterJobs

    return ClusterJobs(connect(destination(argument)), assignment, say)


def connect(there: Destination) -> "Client":
    """A client of the scheduler there. WorkError where nobody answers, or others could listen."""
    from mindlang.executors.cluster_jobs import client_of

    address = there.address()
    client = client_of(address, _security_of(there, address))
    try:
        there.refuse_open(client.scheduler_info()["address"])
    except WorkError:
        client.close()
        raise
    return client


def _security_of(there: Destination, address: str) -> "Security":
    """The encryption of a connection; WorkError where it has to be encrypted, and there is no certificate."""
    from distributed.security import Security

    if not address.startswith("tls:"):
        return Security(require_encryption=False)
    try:
        pem = there.pem and str(Path(there.pem).absolute())
        own = {"tls_ca_file": pem, "tls_client_cert": pem, "tls_client_key": pem} if pem else {}
        security = Security(require_encryption=True, **own)
        context = security.get_connection_args("client")["ssl_context"]
    except (OSError, ValueError) as error:
        where = there.pem or "what Dask is configured with"
        raise WorkError(f"{where} is no certificate with its key: {error}", "docs/cluster.md makes one") from error
    if context is None:
        raise WorkError(
            f"{address} takes who has the cluster's certificate, and none was said",
            f"--on dask:{there.place},tls.pem names the file with the certificate and its key (docs/cluster.md)",
        )
    return security


def _address_in(path: Path) -> str:
    try:
        data = json.loads(read_whole(path, MAX_FILE_BYTES))
    except FileNotFoundError:
        lines = "; ".join((TLS, *sbatch(shlex.quote(str(path)))))
        hint = f"the scheduler writes it when it begins. With SLURM, and tls.pem as in docs/cluster.md: {lines}"
        raise WorkError(f"there is no scheduler file {path}, nor is that an address", hint) from None
    except OSError as error:
        raise WorkError(f"{path} cannot be read: {error.strerror or error}", "it should be a scheduler file") from error
    except (ValueError, RecursionError):
        data = None
    match data:
        case {"address": str(address)} if _parts(address):
            return address
    hint = f"{command_line('dask', 'scheduler', '--scheduler-file', path)} writes one"
    raise WorkError(f"{path} is no scheduler file: it says no address", hint)


def _parts(address: str) -> tuple[str, str] | None:
    """Scheme, tcp or tls, and host of an address; None where it is none."""
    found = ADDRESS.fullmatch(address)
    if not found or not 0 < int(found["port"]) <= MAX_PORT or found["scheme"] not in (None, "tcp", "tls"):
        return None
    return found["scheme"] or "tcp", found["host"].strip("[]")


def _is_loopback(host: str) -> bool:
    try:
        return host == "localhost" or ip_address(host).is_loopback
    except ValueError:
        return False
