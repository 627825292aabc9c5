"""The workers of a Dask cluster, by the address of its scheduler or by the file that it has written."""

from collections.abc import Callable
from importlib.util import find_spec

from mindrun.errors import MindError

from mindlang.executors.jobs import Assignment, JobExecutor
from mindlang.executors.scheduler import address_of, destination, flaw_of

USAGE = "dask:scheduler.json or dask:tls://HOST:8786, with ,tls.pem or ,trusted"


def flaw(argument: str) -> str:
    """What is wrong with an address; nothing where nothing is. MindError without Dask, or a way there that is safe."""
    if find_spec("distributed") is None:
        raise MindError(
            "a cluster is reached with distributed, which is not installed", "pip install 'mindlang[cluster]'"
        )
    if not (found := flaw_of(argument)):
        address_of(destination(argument))
    return found


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """Whoever is connected to the scheduler, now or later."""
    from mindlang.executors.cluster_jobs import ClusterJobs
    from mindlang.executors.connection import connect

    return ClusterJobs(connect(destination(argument)), assignment, say)
