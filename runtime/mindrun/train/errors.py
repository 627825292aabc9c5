"""What can go wrong with a run, in words for its user."""

from mindrun.errors import MindError


class RunError(MindError):
    """A run that cannot begin or go on."""


class NotFoundError(RunError):
    """What was asked for is not there."""
