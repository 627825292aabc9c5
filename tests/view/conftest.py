"""A small mind, and a run of it that is served while a room's tests ask."""

import logging
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.calling import write_rules
from tests.view.serving import Served, request, served, simulated


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The small mind as a file."""
    return write_rules(tmp_path_factory.mktemp("mind"))


@pytest.fixture(scope="module")
def view(path: Path) -> Iterator[Served]:
    """A run of it, served until the module's tests are done."""
    with served(simulated(path)) as found:
        yield found


@pytest.fixture
def goes_on(view: Served, caplog: pytest.LogCaptureFixture) -> Iterator[None]:
    """After whatever was asked the server still answers, and has not failed."""
    with caplog.at_level(logging.WARNING):
        yield
    assert caplog.records == []
    assert view.status(request(view)) == 200
    with view.viewer() as viewer:
        assert viewer.hear("ticks")["known"] >= 0
