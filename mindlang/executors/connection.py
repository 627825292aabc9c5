"""A client of a scheduler: encrypted, unless the way to it is this machine or a network that is trusted."""

import logging
import re
import ssl
import warnings
from pathlib import Path

from distributed import Client
from distributed.security import Security

from mindlang.executors.jobs import WorkError
from mindlang.executors.scheduler import Destination, address_of, refuse_open

CONNECT_SECONDS = 10.0
WHERE = re.compile(r"^in <[^>]*>: ")  # in which of its objects Dask has failed
SHOWN_CHARACTERS = 300  # of what Dask says


def connect(there: Destination) -> Client:
    """A client of the scheduler there. WorkError where nobody answers, or others could listen."""
    address = address_of(there)
    client = client_of(address, security_of(there, address))
    try:
        refuse_open(client.scheduler_info()["address"], there)
    except WorkError:
        client.close()
        raise
    return client


def client_of(address: str, security: Security) -> Client:
    """A client of the scheduler at an address. WorkError where nobody answers."""
    silence()
    try:
        with warnings.catch_warnings():
            # Other versions of what results do not depend on: a worker's build says more.
            warnings.simplefilter("ignore")
            return Client(address, security=security, timeout=CONNECT_SECONDS, set_as_default=False, name="mindc")
    except (OSError, ssl.SSLError, ValueError, TypeError, RuntimeError, ImportError) as error:
        raise _unreachable(address, error) from error


def silence() -> None:
    """Have Dask log nothing of connections that fail: whoever asked for them says so."""
    for name in ("client", "comm", "core", "batched", "deploy", "scheduler", "worker", "nanny"):
        logging.getLogger(f"distributed.{name}").setLevel(logging.CRITICAL)


def security_of(there: Destination, address: str) -> Security:
    """How a connection is encrypted; WorkError where it has to be, and there is no certificate."""
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


def _unreachable(address: str, error: Exception) -> WorkError:
    said = WHERE.sub("", str(error.__cause__ or error).strip()).splitlines()
    hint = "see that the scheduler runs there, and speaks tls or tcp as its address says"
    return WorkError(f"no scheduler answers at {address}: {(said or ['nothing'])[0]:.{SHOWN_CHARACTERS}}", hint)
