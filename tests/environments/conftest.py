"""What a module of tests registers with Gymnasium is gone after it."""

from collections.abc import Iterator

import pytest

try:
    from gymnasium import registry
except ImportError:
    registry = {}


@pytest.fixture(scope="module", autouse=True)
def own_registry() -> Iterator[None]:
    """The names of environments as they were before."""
    before = dict(registry)
    yield
    registry.clear()
    registry.update(before)
