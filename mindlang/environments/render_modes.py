"""How an environment can be seen."""

from collections.abc import Mapping
from typing import Any

from mindrun.errors import MindError

from mindlang.compiler.diagnostic import listed


def refuse_unknown_mode(mode: str | None, metadata: Mapping[str, Any]) -> None:
    """MindError for a `render_mode` that the environment does not have."""
    if mode not in (None, *metadata["render_modes"]):
        known = listed([f'"{each}"' for each in metadata["render_modes"]])
        raise MindError(f'it cannot be rendered as "{mode}"', f"render_mode is {known}, or None")
