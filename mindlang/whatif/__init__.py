"""Counterfactual runs: a run that goes on otherwise from a tick on, beside the run as it was."""
