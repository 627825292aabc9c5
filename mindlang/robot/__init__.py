"""`robot.yaml` read and held against a mind, as a `.mind` file is, and a bundle brought to that robot, whole or not."""

from mindrun.errors import MindError


class DeployError(MindError):
    """A deployment that did not happen, or was taken back: the text says which, `hint` what to do."""
