"""`mindc train --on dask`: the same weights, with tls, too, and one sentence where there is no way to a cluster."""

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from time import sleep

import pytest

from mindlang.executors.dask import TLS, sbatch
from tests.calling import Call
from tests.executors.test_on import RUN
from tests.train.test_train_command import LONG, MIND, train_apart

pytest.importorskip("distributed", reason="distributed is not installed: pip install 'mindlang[cluster]'")

ROOT = Path(__file__).parents[2]
TAUGHT = ("drive.mind", "Go", "--seed", "3", "--generations", "6", "--attempts", "3", "--from-scratch", "--json")
CLUSTER = """
import sys
from distributed import LocalCluster, Security
pem, workers = sys.argv[1], int(sys.argv[2])
tls = {"protocol": "tls", "security": Security(**{f"tls_{who}_{what}": pem for who in ("client", "scheduler", "worker")
    for what in ("cert", "key")}, tls_ca_file=pem, require_encryption=True)} if pem else {}
if __name__ == "__main__":
    here = {"host": "127.0.0.1", "dashboard_address": None, "threads_per_worker": 2}
    with LocalCluster(n_workers=workers, **here, **tls) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
"""


def cluster_on_this_machine(folder: Path, pem: str = "", workers: int = 1) -> Iterator[str]:
    """The address of a scheduler, each of whose workers has two threads."""
    (folder / "cluster.py").write_text(CLUSTER)
    sources = {"PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "runtime")])}
    with subprocess.Popen(
        [sys.executable, "cluster.py", pem, f"{workers}"],
        cwd=folder,
        env=os.environ | sources,
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as process:
        assert process.stdout
        yield process.stdout.readline().strip()
        assert process.stdin
        process.stdin.close()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    yield from cluster_on_this_machine(tmp_path_factory.mktemp("cluster"))


@pytest.fixture
def pem(tmp_path: Path) -> str:
    """A certificate and its key, as docs/cluster.md makes them."""
    if not shutil.which("openssl"):
        pytest.skip("openssl is not installed, which makes a certificate")
    words = "req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=mind -keyout tls.pem -out tls.pem"
    subprocess.run(["openssl", *words.split()], cwd=tmp_path, check=True, capture_output=True)
    return str(tmp_path / "tls.pem")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "drive.mind").write_text(MIND)
    return tmp_path


def weights(project: Path, *words: str) -> dict[str, str]:
    done = train_apart(project, *words)
    assert done.returncode == 0, done.stderr
    found: dict[str, str] = json.loads(done.stdout)["weights"]
    return found


@pytest.mark.slow
def test_the_weights_are_those_of_threads(project: Path, cluster: str, pem: str) -> None:
    expected = weights(project, *TAUGHT, "--runs", "threads")
    (project / "scheduler.json").write_text(json.dumps({"type": "Scheduler", "address": cluster}))
    assert weights(project, *TAUGHT, "--runs", "dask", "--on", "dask:scheduler.json") == expected
    for address in cluster_on_this_machine(project, pem):
        assert address.startswith("tls://")
        assert weights(project, *TAUGHT, "--runs", "tls", "--on", f"dask:{address},tls.pem") == expected
        refused = train_apart(project, *TAUGHT, "--on", f"dask:{address}")
        assert (refused.returncode, "none was said" in refused.stderr) == (1, True)


def test_the_runs_are_those_of_threads(mindc: Call, drive: Path, cluster: str) -> None:
    assert mindc("train", drive, "Go", "Drive", "--seed", "3", "-q").code == 0
    rows = []
    for words in ((), ("--on", f"dask:{cluster}")):
        done = mindc("bench", drive, "--task", "Reach", "--runs", 90, "--csv", "runs.csv", *words)
        assert done.code == 0, done.err
        rows.append(Path("runs.csv").read_bytes())
    assert rows[0] == rows[1]
    assert f"by dask:{cluster}, in" in " ".join(done.out.split())


@pytest.mark.slow
def test_ctrl_c_leaves_a_run_that_goes_on_to_the_same_weights(project: Path, cluster: str) -> None:
    expected = weights(project, *LONG, "--runs", "undisturbed")
    command = [sys.executable, "-c", "from mindlang.cli import main; main()", "train", *LONG, "--on", f"dask:{cluster}"]
    with subprocess.Popen(command, cwd=project, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        logs = project.glob("runs/Go-on-Reach/*/progress.jsonl")
        while process.poll() is None and not any(log.stat().st_size for log in logs):
            sleep(0.005)
            logs = project.glob("runs/Go-on-Reach/*/progress.jsonl")
        process.send_signal(signal.SIGINT)
        _, talk = process.communicate()
    assert process.returncode in (0, 130), talk  # a short lesson may have ended
    assert "Traceback" not in talk
    assert weights(project, *LONG, "--on", f"dask:{cluster}") == expected


@pytest.mark.slow
def test_the_first_ctrl_c_stops_where_no_worker_has_begun(project: Path) -> None:
    for address in cluster_on_this_machine(project, workers=0):
        words = ["train", *TAUGHT, "--attempts", "1", "--on", f"dask:{address}"]
        command = [sys.executable, "-c", "from mindlang.cli import main; main()", *words]
        with subprocess.Popen(command, cwd=project, stderr=subprocess.PIPE, text=True) as process:
            while process.poll() is None and not [*project.glob(f"{RUN}/progress.jsonl")]:
                sleep(0.005)
            process.send_signal(signal.SIGINT)
            try:
                _, talk = process.communicate(timeout=60)
            finally:
                process.kill()
        assert process.returncode == 130, talk
        assert "Ctrl-C again" not in talk
        assert f"saved; to go on: mindc train --resume {next(project.glob(RUN)).relative_to(project)}" in talk
    assert train_apart(project, "--resume", str(next(project.glob(RUN)))).returncode == 0


@pytest.mark.parametrize(
    ("where", "code", "words"),
    [
        (
            "dask:moon.json",
            2,
            'sbatch --array 1-8 -c 4 --requeue --wrap "dask worker --scheduler-file moon.json --nthreads 4 $TLS"',
        ),
        ("dask:tls://127.0.0.1:9,none.pem", 1, "none.pem is no certificate with its key"),
    ],
)
def test_where_there_is_no_way_to_a_cluster_it_is_said(
    mindc: Call, drive: Path, where: str, code: int, words: str
) -> None:
    done = mindc("train", *TAUGHT, "--on", where)
    assert (done.code, words in done.err) == (code, True), done.err


def test_the_help_has_the_two_lines_for_slurm(mindc: Call) -> None:
    said = " ".join(mindc("train", "--help").out.replace("\\\n", " ").split())
    assert all(line in said for line in (TLS, *sbatch("scheduler.json")))
