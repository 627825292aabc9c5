"""The page of `mindc view`, which is built before a package is made."""

from collections.abc import Iterator
from pathlib import Path

import mindlang
from mindlang.diagnosis.finding import Finding, State


def check() -> Iterator[Finding]:
    """One finding."""
    page = Path(mindlang.__file__).parent / "view" / "page" / "index.html"
    if page.is_file():
        yield Finding("viewer", State.FINE, "its page is there")
    else:
        yield Finding("viewer", State.WRONG, f"{page} is missing", "cd viewer && npm ci && npm run build")
