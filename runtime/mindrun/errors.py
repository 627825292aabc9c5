"""What can be wrong with what a mind is given: each error's text is one sentence for the user."""

import errno
import os

OUR_OWN = ("mindlang", "mindrun")


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


def reason(error: Exception) -> str:
    """Why something cannot be read or written, in the words of the system where those are all there is."""
    if isinstance(error, OSError) and error.errno == errno.EBADF:
        return "it is closed"
    return getattr(error, "strerror", None) or str(error)


def text_of(error: BaseException) -> str:
    """What an error of somebody else's code says, in one line; the name of its type where it says nothing, or fails."""
    try:
        said = " ".join(str(error).split())
    except BaseException:  # it is that code which says it
        said = ""
    return said or type(error).__name__


def surroundings(error: Exception) -> str:
    """A sentence for errors of the machine, of files and of the installation, about which a user can do something."""
    match error:
        case OSError():
            return _of_system(error)
        case MemoryError():
            return (
                f"there is not enough memory for this ({error})"
                if str(error)
                else "there is not enough memory for this"
            )
        case RecursionError():
            return "something here is nested too deep"
        case UnicodeError():
            return f"there is text that cannot be read or written in its encoding ({error})"
        case ImportError() if (error.name or "").partition(".")[0] not in OUR_OWN:
            return f"something that is needed is not installed, or cannot be loaded: {error}"
        case RuntimeError() if "thread" in str(error):
            return f"the system gives no more threads ({error})"
    return ""


def _of_system(error: OSError) -> str:
    if error.filename is not None:
        return f"{error.strerror}: {error.filename}"
    try:
        os.getcwd()  # noqa: PTH109
    except OSError:
        return "the folder in which this was started is gone"
    return reason(error)
