"""What the pages share: a mindc that has been imported already."""

import os
import subprocess
import sys
from collections.abc import Iterator

import pytest

from tests.pages.server import ADDRESS, READY
from tests.project.sources import ROOT


@pytest.fixture(scope="session")
def imported_mindc(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A process that becomes mindc when it is asked to."""
    address = str(tmp_path_factory.mktemp("server") / "socket")
    path = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
    code = "import sys; from tests.pages.server import serve; serve(sys.argv[1])"
    with pytest.MonkeyPatch.context() as patch, subprocess.Popen(
        [sys.executable, "-c", code, address], env=os.environ | {"PYTHONPATH": path, "MPLBACKEND": "agg"},
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        assert process.stdout
        assert process.stdout.readline() == READY
        patch.setenv(ADDRESS, address)
        yield
        process.kill()
