"""The images of a run in an environment, as a page has them that no server answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cv2
from mindrun.errors import MindError

from mindlang.view.environment_images import Image, data_url
from mindlang.view.texts import error_text
from mindlang.view.viewed import Viewed

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
        """What is left out, in a sentence; empty where nothing is."""
        if self.why:
            return f"the page has no images: {self.why}"
        if self.every == 1:
            return ""
        return f"the page has an image of every {self.every} ticks: all would be more than {MAX_IMAGES_BYTES >> 20} MiB"


def exported_images(viewed: Viewed, drawn: Callable[[int], None]) -> ExportedImages | None:
    """As many of a run that is over as fit; None where its world is no environment. `drawn` is told of each tick."""
    if viewed.drawing is None:
        return None
    images: list[str] = []
    every, size = 1, 0
    try:
        for tick in range(viewed.known + 1):
            if tick % every == 0:
                images.append(data_url(_reduced(viewed.image(tick)), "webp", QUALITY))
                size += len(images[-1])
            while size > MAX_IMAGES_BYTES and len(images) > 1:
                images, every = images[::2], 2 * every
                size = sum(map(len, images))
            drawn(tick)
    except MindError as error:
        return ExportedImages(1, (), error_text(error))
    return ExportedImages(every, images)


def _reduced(image: Image) -> Image:
    """The image, smaller where it is larger than a page shows it."""
    scale = MAX_SIDE_PIXELS / max(image.shape)
    if scale >= 1:
        return image
    height, width, _ = image.shape
    size = max(1, round(scale * width)), max(1, round(scale * height))
    return cv2.resize(image, size, interpolation=cv2.INTER_AREA).astype(image.dtype)
