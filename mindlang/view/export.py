"""A run as one file: the page with all rows in it, which opens from a disk without a server.

Rows are kept to the bit. Each column is the difference (exclusive or) of every value to that before it, its bytes apart
by their place in the number, and all of it deflated: what does not change costs nothing. The images of a run in an
environment are made smaller, and fewer, until they fit.
"""

import base64
import hashlib
import json
import zlib
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from mindrun.errors import MindError
from numpy.typing import NDArray

from mindlang.pictures.canvas import reduced
from mindlang.view.messages import error_text
from mindlang.view.rows import DOUBLE_BLOCK, SINGLE_BLOCK
from mindlang.view.viewed import Viewed, data_url

PAGE = Path(__file__).parent / "page"
MAX_EXPORTED_BYTES = 512 << 20  # of rows, which a browser holds in memory
SCRIPT, STYLE = '<script defer src="view.js"></script>', '<link rel="stylesheet" href="view.css" />'
MAX_IMAGES_BYTES = 64 << 20  # of all images, as text
MAX_SIDE_PIXELS = 1000
QUALITY = cv2.IMWRITE_WEBP_QUALITY, 90  # a fifth of a PNG, and as fast for a photograph as for a drawing


@dataclass(frozen=True, slots=True)
class ExportedImages:
    """Images of the ticks 0, `every`, 2 · `every` …; `why` says what is wrong where there are none."""

    every: int
    images: Sequence[str]
    why: str = ""

    @property
    def note(self) -> str:
        """The images that are left out, in a sentence; empty where none are."""
        if self.why:
            return f"the page has no images: {self.why}"
        if self.every == 1:
            return ""
        return f"the page has an image of every {self.every} ticks: all would be more than {MAX_IMAGES_BYTES >> 20} MiB"


def exported_images(viewed: Viewed, drawn: Callable[[int], None]) -> ExportedImages | None:
    """The images of a finished run, as many as fit; None without an environment. `drawn` is called with each tick."""
    if viewed.drawing is None:
        return None
    images: list[str] = []
    every, size = 1, 0
    try:
        for tick in range(viewed.known + 1):
            if tick % every == 0:
                image = viewed.image(tick)
                scale = MAX_SIDE_PIXELS / max(image.shape)
                images.append(data_url(reduced(image, scale) if scale < 1 else image, "webp", QUALITY))
                size += len(images[-1])
            while size > MAX_IMAGES_BYTES and len(images) > 1:
                images, every = images[::2], 2 * every
                size = sum(map(len, images))
            drawn(tick)
    except MindError as error:
        return ExportedImages(1, (), error_text(error))
    return ExportedImages(every, images)


def refuse_too_large_page(viewed: Viewed) -> None:
    """MindError where so many rows do not fit into a page."""
    columns = viewed.columns
    size = (viewed.known + 1) * (8 * columns.width(DOUBLE_BLOCK) + 4 * columns.width(SINGLE_BLOCK))
    if size > MAX_EXPORTED_BYTES:
        raise MindError(
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
    """A content security policy for only this script and style: nothing that a name contains runs or is fetched."""
    run, look = (
        f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in (script, style)
    )
    return f"default-src 'none'; script-src {run}; style-src {look}; img-src data:; base-uri 'none'; form-action 'none'"


def _inert(data: dict[str, Any]) -> str:
    return json.dumps(data, allow_nan=False).replace("<", "\\u003c")


def _rows(viewed: Viewed) -> str:
    numbers = np.arange(viewed.known + 1)
    deflate = zlib.compressobj(9)
    parts = [deflate.compress(_differences(column, "<u8")) for column in viewed.doubles(numbers).T]
    parts += [deflate.compress(_differences(column, "<u4")) for column in viewed.singles(numbers).T]
    return base64.b64encode(b"".join([*parts, deflate.flush()])).decode()


def _differences(column: NDArray[Any], as_bits: str) -> bytes:
    """The bytes of a column: the lowest of all differences, then the next ones."""
    bits = np.ascontiguousarray(column).view(as_bits).copy()
    bits[1:] ^= bits[:-1].copy()
    return bits.view(np.uint8).reshape(len(bits), -1).T.tobytes()
