"""Hypothesis for mutants: no shrinking, nothing remembered. What fails is enough, whatever it is."""

from hypothesis import Phase, settings

settings.register_profile("mutation", deadline=None, database=None, phases=[Phase.explicit, Phase.generate])
settings.load_profile("mutation")
# That of tests/conftest.py would take its place.
type.__setattr__(settings, "load_profile", staticmethod(lambda name: None))
