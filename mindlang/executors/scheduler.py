"""Where a scheduler is, by what stands behind `dask:`, and whether what goes there may be read by others on the way."""

import json
import re
import shlex
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path

from mindrun.files.regular_files import read_whole
from mindrun.terminal.command_line import command_line

from mindlang.executors.jobs import WorkError

TRUSTED = "trusted"  # the network is, and nothing has to be encrypted
MAX_FILE_BYTES = 1 << 24
MAX_PORT = 65535
ADDRESS = re.compile(r"(?:(?P<scheme>[a-z]+)://)?(?P<host>\[[0-9a-fA-F:.%]+\]|[\w.-]+):(?P<port>\d{1,5})/?")
TLS = 'TLS="--protocol tls --tls-ca-file tls.pem --tls-cert tls.pem --tls-key tls.pem"'


@dataclass(frozen=True, slots=True)
class Destination:
    """What stands behind `dask:`: an address or a scheduler file, and how it is reached.

    `pem` is a file with a certificate and its key, which everybody in the cluster has; empty where Dask's own
    configuration says it. With `is_trusted` nothing needs to be encrypted.
    """

    place: str
    pem: str = ""
    is_trusted: bool = False


def sbatch(path: str) -> tuple[str, str]:
    """The two lines that begin a cluster with SLURM: a scheduler that writes this file, eight workers of 4 cores."""
    return (
        f'sbatch --wrap "dask scheduler --scheduler-file {path} $TLS"',
        f'sbatch --array 1-8 -c 4 --requeue --wrap "dask worker --scheduler-file {path} --nthreads 4 $TLS"',
    )


def destination(argument: str) -> Destination:
    """What an argument says."""
    place, comma, how = argument.partition(",")
    if comma and how == TRUSTED:
        return Destination(place, is_trusted=True)
    return Destination(place, how)


def flaw_of(argument: str) -> str:
    """What is wrong with an argument by itself; nothing where nothing is."""
    there = destination(argument)
    if not there.place or argument.endswith(","):
        return "it says no scheduler"
    if "://" in there.place and (not (parts := _parts(there.place)) or parts[0] not in ("tcp", "tls")):
        return f"{there.place!r:.60} is no address"
    return ""


def address_of(there: Destination) -> str:
    """The address of the scheduler, as scheme://host:port. WorkError where there is no file that says one.

    And where it leads to another machine, and nothing is encrypted on the way.
    """
    address = there.place if _parts(there.place) else _address_in(Path(there.place))
    refuse_open(address, there)
    return address if "://" in address else f"tcp://{address}"


def refuse_open(address: str, there: Destination) -> None:
    """WorkError where others could read and write what goes to an address, unless the network is said to be trusted."""
    scheme, host = _parts(address) or ("", "")
    if scheme == "tls" or there.is_trusted or _is_loopback(host):
        return
    raise WorkError(
        f"what goes to {address} is not encrypted, and whoever reaches that port can run code there",
        "begin scheduler and workers with tls (docs/cluster.md), or where nobody else is in the network: "
        f"--on dask:{there.place},{TRUSTED}",
    )


def _address_in(path: Path) -> str:
    """The address in a scheduler file."""
    try:
        data = json.loads(read_whole(path, MAX_FILE_BYTES))
    except FileNotFoundError:
        lines = "; ".join((TLS, *sbatch(shlex.quote(str(path)))))
        hint = f"the scheduler writes it when it begins. With SLURM, and tls.pem as in docs/cluster.md: {lines}"
        raise WorkError(f"there is no scheduler file {path}, nor is that an address", hint) from None
    except OSError as error:
        raise WorkError(f"{path} cannot be read: {error.strerror or error}", "it should be a scheduler file") from error
    except (ValueError, RecursionError) as error:
        raise _no_scheduler_file(path) from error
    match data:
        case {"address": str(address)} if (parts := _parts(address)) and parts[0] in ("tcp", "tls"):
            return address
    raise _no_scheduler_file(path)


def _no_scheduler_file(path: Path) -> WorkError:
    hint = f"{command_line('dask', 'scheduler', '--scheduler-file', path)} writes one"
    return WorkError(f"{path} is no scheduler file: it says no address", hint)


def _parts(address: str) -> tuple[str, str] | None:
    """Scheme and host of an address; None where it is none."""
    found = ADDRESS.fullmatch(address)
    if not found or not 0 < int(found["port"]) <= MAX_PORT:
        return None
    return found["scheme"] or "tcp", found["host"].strip("[]")


def _is_loopback(host: str) -> bool:
    try:
        return host == "localhost" or ip_address(host).is_loopback
    except ValueError:
        return False
