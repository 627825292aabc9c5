"""Kinds of events: what can happen in a tick. `sim/lanes/judge.py` notices them."""
