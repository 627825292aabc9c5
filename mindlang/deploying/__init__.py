"""Bringing a bundle to a robot over the system's ssh and rsync: beside the old one, verified, switched at once."""

from mindrun.errors import MindError


class DeployError(MindError):
    """A deployment that did not happen, or was taken back: the text says which, `hint` what to do."""
