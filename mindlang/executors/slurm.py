"""Jobs of SLURM, each a worker of Dask: `dask_jobqueue` submits them, and others in the place of those that end."""

import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from mindlang.executors.jobs import Assignment, JobExecutor, WorkError, refuse_without

USAGE = "slurm:N, or slurm:N,cores=4,memory=8GB with queue=, account=, walltime="
OPTIONS = ("cores", "memory", "queue", "account", "walltime")
MAX_JOBS = 10_000
MAX_CORES = 10_000


def flaw(argument: str) -> str:
    """The flaw of a number of jobs with their options; "" where they have none. MindError without dask-jobqueue."""
    refuse_without(("dask_jobqueue",), "SLURM is asked by", "slurm")
    count, *options = argument.split(",")
    if not _is_count(count, MAX_JOBS):
        return f"{count!r:.40} is no number of jobs from 1 to {MAX_JOBS}"
    for each in options:
        name, _, value = each.partition("=")
        if name not in OPTIONS or not value or not value.isprintable():
            return f"{each!r:.40} says none of {', '.join(OPTIONS)}"
        if name == "cores" and not _is_count(value, MAX_CORES):
            return f"{value!r:.40} is no number of cores"
    return ""


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """A scheduler in this process, and so many jobs; the rest is read in ~/.config/dask/jobqueue.yaml."""
    handler = signal.getsignal(signal.SIGINT)
    from dask_jobqueue import SLURMCluster

    signal.signal(signal.SIGINT, handler)  # which that import has taken, so that Ctrl-C would leave nothing saved
    from mindlang.executors.cluster_jobs import jobs_of_cluster, silence

    silence()
    count, *options = argument.split(",")
    said: dict[str, Any] = dict(each.split("=", 1) for each in options)
    if "cores" in said:
        said["cores"] = int(said["cores"])
    try:
        cluster = SLURMCluster(
            **said,
            security=True,
            shared_temp_directory=f"{Path.cwd()}",
            scheduler_options={"dashboard": False, "dashboard_address": None},
        )
        cluster.adapt(minimum_jobs=int(count), maximum_jobs=int(count))
    except (ValueError, OSError, ImportError) as error:
        raise WorkError(f"SLURM's jobs cannot be begun: {error}", f"--on says it so: {USAGE}") from error

    def end() -> None:
        with suppress(Exception):
            cluster.close()

    return jobs_of_cluster(cluster, cluster.security, assignment, say, end)


def _is_count(text: str, most: int) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= len(f"{most}") and 1 <= int(text) <= most
