"""Texts of a mind or of a recording as a page may show them, whoever wrote them."""

from mindrun.errors import MindError
from mindrun.files.printable import visible

SHOWN_CHARACTERS = 200


def shown(text: str) -> str:
    """The text with control and direction characters spelt out, and no longer than a page can show."""
    spelt = visible(text[: SHOWN_CHARACTERS + 1])
    return spelt if len(spelt) <= SHOWN_CHARACTERS else spelt[: SHOWN_CHARACTERS - 1] + "…"


def error_text(error: MindError) -> str:
    """What is wrong, and what to do."""
    return shown("; ".join(filter(None, (str(error), error.hint))))
