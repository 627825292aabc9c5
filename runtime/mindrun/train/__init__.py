"""Training: a learner teaches one skill one lesson, in a run folder that survives anything."""

from mindrun.errors import MindError


class RunError(MindError):
    """A run that cannot begin or go on."""


class NotFoundError(RunError):
    """The run, curriculum or lesson that was asked for is not there."""
