"""mindc, and a mind to run."""

from pathlib import Path

import pytest

from tests.calling import Call, caller, write_rules


@pytest.fixture
def mindc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    return caller(capsys, monkeypatch)


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    return write_rules(tmp_path)
