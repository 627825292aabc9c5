"""The folder in which a user wants things kept that can be made again."""

import os
from pathlib import Path


def user_cache() -> Path:
    """`mind` in the user's cache, by the XDG base directories; RuntimeError where there is no home."""
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        return Path(given).absolute()  # a relative one is of the folder in which we began
    shared = Path(os.environ.get("XDG_CACHE_HOME", ""))  # of which a relative one does not count
    return (shared if shared.is_absolute() else Path.home().absolute() / ".cache") / "mind"
