"""What can be wrong with what a mind is given: each error's text is one sentence for the user."""


class MindError(Exception):
    """Something a user gave is wrong: the text says what, and `hint`, where there is one, what to do."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


class WeightsError(MindError):
    """A skill's weights are missing, not finite, or not as many as its function has."""


class ProcedureError(MindError):
    """A procedure is missing, raised an exception, or returned something that is not one number per output."""


class BundleError(MindError):
    """A bundle, or a graph read from data, is damaged or was made by something else."""


class ReadingsError(MindError):
    """Readings that do not fit the mind's sensors."""
