"""Kinds of measures: numbers for rewards, taken every tick after the step by `sim/lanes/judge.py`."""
