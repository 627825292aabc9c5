"""What all tests share."""

import gc
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import settings
from mindrun.processors import cores

from tests.calling import Call, caller, write_rules
from tests.draws import EXPLORE

# A shared machine takes its time. What decides over a commit draws the same cases whenever it is run;
# `make test-slow` draws new ones: pytest --hypothesis-profile explore
settings.register_profile("same", deadline=None, derandomize=True, max_examples=20)
settings.register_profile(EXPLORE, deadline=None)
settings.load_profile("same")

# A shell that starts the tests in the background has them ignore Ctrl-C, and so every program that they start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """Of `--numprocesses auto`: twice as many as processors, for a test often waits for a program or a clock."""
    return 2 * cores()


# What is imported and collected here stays until the end: it is not looked through for what is garbage, now or later.
gc.disable()


def pytest_collection_finish() -> None:
    """Have what comes from now on be collected."""
    gc.freeze()
    gc.enable()


# Hundreds of programs are started here, and each would compile all of its modules anew.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False


def pytest_sessionstart(session: pytest.Session) -> None:
    """Where several processes test, one more compiles the simulator for all of them: who needs it waits for that."""
    is_worker = hasattr(session.config, "workerinput")
    if session.config.getoption("numprocesses", None) and not is_worker:
        subprocess.Popen([sys.executable, "-m", "mindrun.sim.warmup"], stdin=subprocess.DEVNULL)


# Folders here: what needs no simulator is tested while that is compiled, what takes long is not left for the end.
WITHOUT_SIMULATOR = ("language", "lint", "fmt", "explain", "server", "proofs", "wiring", "deploy", "formats")
LONG = ("pages", "executors", "outside", "examples", "train", "sim", "engine", "functions", "environments", "robot")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Set the order of the tests, in which processes take them."""
    first = "test_style.py"  # which has mypy, the longest of all where it has no cache
    ranks = dict.fromkeys(WITHOUT_SIMULATOR, 0) | dict.fromkeys(LONG, 1)
    here = Path(__file__).parent
    items.sort(key=lambda item: (item.path.name != first, ranks.get(item.path.relative_to(here).parts[0], 2)))


@pytest.fixture
def mindc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    """Mindc called in this process."""
    return caller(capsys, monkeypatch)


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    """A small mind that has nothing to learn, as a file."""
    return write_rules(tmp_path)


@pytest.fixture
def drive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A mind with two quick lessons, as a file in the working folder."""
    from tests.edits.taught import write_mind  # what most tests need not import
    from tests.train.test_train_command import MIND

    monkeypatch.chdir(tmp_path)
    return write_mind(tmp_path, MIND)
