"""Hypothesis for mutants: fewer examples, no shrinking, nothing remembered. What fails is enough, whatever it is."""

from collections.abc import Sequence
from typing import Any

from hypothesis import Phase, settings

FEWER_FACTOR = 4  # times fewer examples
GIVEN = "_hypothesis_internal_use_settings"

settings.register_profile("mutation", deadline=None, database=None, phases=[Phase.explicit, Phase.generate])
settings.load_profile("mutation")
# That of tests/conftest.py would take its place.
type.__setattr__(settings, "load_profile", staticmethod(lambda name: None))


def pytest_collection_modifyitems(items: Sequence[Any]) -> None:
    """Mutants are many, and each failure ends the tests of one."""
    for item in items:
        test = getattr(item, "obj", None)
        if given := getattr(test, GIVEN, None):
            setattr(test, GIVEN, settings(given, max_examples=-(-given.max_examples // FEWER_FACTOR)))
