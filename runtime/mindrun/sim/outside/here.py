"""What `mindrun.work.assigned` steps environments with, until it asks for a stepper itself."""

from mindrun.sim.outside.subprocess_stepper import SubprocessStepper as Here

__all__ = ("Here",)
