"""`--on slurm:2` with an sbatch that begins jobs on this machine."""

import os
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

if find_spec("dask_jobqueue") is None:  # whose import takes Ctrl-C away from the tests
    pytest.skip("dask-jobqueue is not installed: pip install 'mindlang[slurm]'", allow_module_level=True)
pytest.importorskip("cryptography", reason="cryptography is not installed: pip install 'mindlang[slurm]'")

from mindlang.executors import jobs, slurm
from tests.calling import Call
from tests.executors.test_on import TAUGHT, weights

ROOT = Path(__file__).parents[2]
SBATCH = f"""#!{sys.executable}
import pathlib, shutil, subprocess, sys
here = pathlib.Path(sys.argv[0]).parent
job = shutil.copy(sys.argv[1], here / "job.sh")
with (here / "jobs.log").open("a") as log, open("/dev/null", "w") as nothing:
    pid = subprocess.Popen(["bash", job], start_new_session=True, stdout=nothing, stderr=nothing).pid
    log.write(f"{{pid}}\\n")
print(f"Submitted batch job {{pid}}")
"""
SCANCEL = f"""#!{sys.executable}
import os, signal, sys
for job in sys.argv[1:]:
    os.killpg(int(job), signal.SIGKILL)
    with open(sys.argv[0] + ".log", "a") as log:
        print(job, file=log)
"""


@pytest.fixture
def cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the commands of SLURM, on the PATH."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name, text in (("sbatch", SBATCH), ("scancel", SCANCEL)):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), str(ROOT / "runtime")]))
    return folder


@pytest.mark.slow
def test_it_teaches_the_weights_of_threads_and_cancels_its_jobs(mindc: Call, tmp_path: Path, cluster: Path) -> None:
    expected = weights(mindc, tmp_path / "threads")
    where = "slurm:2,cores=1,memory=2GB,queue=short,walltime=00:30:00"
    assert weights(mindc, tmp_path / "there", "--on", where) == expected
    assert "#SBATCH -p short" in (cluster / "job.sh").read_text()
    assert "--protocol tls://" in (cluster / "job.sh").read_text()
    jobs = (cluster / "jobs.log").read_text().split()
    assert len(jobs) == 2
    assert {*(cluster / "scancel.log").read_text().split()} == {*jobs}, "all that are begun are killed"


def test_what_a_job_is_has_to_be_said(mindc: Call, drive: Path, cluster: Path) -> None:
    done = mindc("train", *TAUGHT, "--on", "slurm:2")
    assert (done.code, "cores and memory" in done.err, "memory=8GB" in done.err) == (1, True, True)


def test_without_the_package_its_line_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jobs, "find_spec", lambda name: None)
    with pytest.raises(jobs.MindError, match="which is not installed") as error:
        slurm.flaw("2")
    assert error.value.hint == "pip install 'mindlang[slurm]'"
