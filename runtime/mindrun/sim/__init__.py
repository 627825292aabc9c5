"""Simulated worlds: many of them in lanes, compiled once for every program."""
