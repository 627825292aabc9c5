"""A run as one file: the page with all rows in it, which opens from a disk without a server.

Rows are kept to the bit. Each column is the difference (exclusive or) of every value to that before it, its bytes apart
by their place in the number, and all of it deflated: what does not change costs nothing.
"""

from __future__ import annotations

import base64
import hashlib
import json
import zlib
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.errors import MindError
from numpy.typing import NDArray

from mindlang.view.columns import DOUBLE_BLOCK, SINGLE_BLOCK
from mindlang.view.exported_images import ExportedImages
from mindlang.view.viewed import Viewed

PAGE = Path(__file__).parent / "page"
MAX_EXPORTED_BYTES = 512 << 20  # of rows, which a browser holds in memory
SCRIPT, STYLE = '<script defer src="view.js"></script>', '<link rel="stylesheet" href="view.css" />'


class ExportError(MindError):
    """A run that does not fit into a file."""


def refuse_too_long(viewed: Viewed) -> None:
    """ExportError where so many rows do not fit into a page."""
    columns = viewed.columns
    size = (viewed.known + 1) * (8 * columns.width(DOUBLE_BLOCK) + 4 * columns.width(SINGLE_BLOCK))
    if size > MAX_EXPORTED_BYTES:
        raise ExportError(
            f"{viewed.known:,} ticks of this mind are {size >> 20:,} MiB, more than a page can hold",
            "see it with a server: leave --export out",
        )


def exported(about: dict[str, Any], ticks: dict[str, Any], viewed: Viewed, images: ExportedImages | None) -> str:
    """The page as HTML with a run that is over; `about` and `ticks` are what a server would have said of it."""
    script, style = ((PAGE / name).read_text("utf-8") for name in ("view.js", "view.css"))
    policy = f'<meta http-equiv="Content-Security-Policy" content="{_policy(script, style)}" />'
    data = {"about": about | {"edits": False}, "ticks": ticks, "rows": viewed.known + 1}
    data |= {"images": images and asdict(images)}
    body = "\n".join([
        f'<script type="application/json" id="recording">{_inert(data)}</script>',
        f'<script type="text/plain" id="rows">{_rows(viewed)}</script>',
        f"<script>{script}</script>\n  </body>",
    ])  # fmt: skip
    page = (PAGE / "index.html").read_text("utf-8")
    return page.replace(SCRIPT, "").replace(STYLE, f"{policy}\n    <style>{style}</style>").replace("</body>", body)


def _policy(script: str, style: str) -> str:
    """Only this script and this style: whatever a name says, nothing else runs, and nothing is asked for."""
    run, look = (
        f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in (script, style)
    )
    return f"default-src 'none'; script-src {run}; style-src {look}; img-src data:; base-uri 'none'; form-action 'none'"


def _inert(data: dict[str, Any]) -> str:
    """JSON in which no tag of HTML can stand."""
    return json.dumps(data, allow_nan=False).replace("<", "\\u003c")


def _rows(viewed: Viewed) -> str:
    numbers = np.arange(viewed.known + 1)
    doubles, singles = viewed.blocks.doubles(numbers), viewed.singles(numbers)
    deflate = zlib.compressobj(9)
    parts = [deflate.compress(_differences(column, "<u8")) for column in doubles.T]
    parts += [deflate.compress(_differences(column, "<u4")) for column in singles.T]
    return base64.b64encode(b"".join([*parts, deflate.flush()])).decode()


def _differences(column: NDArray[Any], as_bits: str) -> bytes:
    """The bytes of a column: the lowest of all differences, then the next ones."""
    bits = np.ascontiguousarray(column).view(as_bits).copy()
    bits[1:] ^= bits[:-1].copy()
    return bits.view(np.uint8).reshape(len(bits), -1).T.tobytes()
