"""What can go wrong with a run, in words for its user."""

from mindrun.errors import MindError


class RunError(MindError):
    """A run that cannot begin or go on: what is wrong, and in `hint` what to do."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


class NotFoundError(RunError):
    """What was asked for is not there."""
