"""Simulated worlds: many of them in lanes, compiled once for every program."""

from mindrun.sim.versions import refuse_unknown

refuse_unknown()  # before anything of it imports what another version may not have
