"""Work for other machines: jobs as bytes, a worker that answers them, and who gives them out."""

from mindrun.errors import MindError


class WorkError(MindError):
    """Work that no worker can do."""
