"""The words of a name."""

import re

_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def words(name: str) -> list[str]:
    """The words of a name in lower case, whether underscores or capitals part them: left_wheel, LeftWheel."""
    return [word.lower() for word in _WORD.findall(name)]
