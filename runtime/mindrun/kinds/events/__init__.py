"""Kinds of events, one file each: what can happen in a tick. `sim/lanes/judge.py` notices them."""
