"""What can go wrong on the way to a robot."""

from mindrun.errors import MindError


class DeployError(MindError):
    """A deployment that did not happen, or was taken back: the text says which, `hint` what to do."""
