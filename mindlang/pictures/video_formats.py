"""The files that a film can become: mp4 by OpenCV, and GIF by Pillow, which a README shows without a player.

OpenCV writes GIFs as well, but no palette for all images: 150 images took it 7.0 s and 8.4 MB, Pillow 0.6 s and 6.7 MB.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Protocol

import cv2
import numpy as np
from mindrun.errors import MindError
from PIL import Image as Pillow

from mindlang.pictures.canvas import Image

PALETTE_COLOURS = 255  # one of 256 is left for pixels that stay as they were
PALETTE_SAMPLES = 6  # images from which the colours of a GIF are taken
GIF_SCALE = 0.75  # of a film's width and height
MAX_GIF_IMAGES = 600  # all are in memory until they are written


class VideoError(MindError):
    """A video that cannot be encoded or written."""


class Images(Protocol):
    """The images of a film, by their numbers from 0."""

    def __len__(self) -> int: ...

    def __getitem__(self, number: int) -> Image: ...


@dataclass(frozen=True, slots=True)
class VideoFormat:
    """How many images a second has, how long a whole run lasts where nobody says a speed, and how it is encoded.

    `encode` writes images to a file and tells of each; it raises VideoError. `most` is how many it takes.
    """

    fps: int
    seconds: float
    encode: Callable[[Path, Images, int, Callable[[], None]], None]
    most: int | None = None


def _mp4(path: Path, images: Images, fps: int, wrote: Callable[[], None]) -> None:
    height, width = images[0].shape[:2]
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), fps, (width, height))
    try:
        if not writer.isOpened():
            raise VideoError("OpenCV cannot encode a video there")
        for number in range(len(images)):
            writer.write(images[number])
            wrote()
    finally:
        writer.release()
    if _images_in(path) != len(images):
        raise VideoError("it is not whole: is the disk full?")


def _images_in(path: Path) -> int:
    video = cv2.VideoCapture(str(path))
    count = int(video.get(cv2.CAP_PROP_FRAME_COUNT))
    video.release()
    return count


def _gif(path: Path, images: Images, fps: int, wrote: Callable[[], None]) -> None:
    """One palette for all images and no dithering: what does not move costs nothing."""
    samples = [_small(images[int(number)]) for number in np.linspace(0, len(images) - 1, PALETTE_SAMPLES)]
    palette = Pillow.fromarray(np.concatenate(samples)).quantize(PALETTE_COLOURS, dither=Pillow.Dither.NONE)

    def each() -> Iterator[Pillow.Image]:
        for number in range(len(images)):
            yield Pillow.fromarray(_small(images[number])).quantize(palette=palette, dither=Pillow.Dither.NONE)
            wrote()

    drawn = each()
    first = next(drawn)
    first.save(path, "GIF", save_all=True, append_images=chain(drawn), duration=round(1000 / fps), loop=0)


def _small(image: Image) -> Image:
    """An image as small as in a GIF, red first."""
    size = round(GIF_SCALE * image.shape[1]), round(GIF_SCALE * image.shape[0])
    return np.ascontiguousarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA)[..., ::-1]).astype(np.uint8)


FORMATS = {
    ".mp4": VideoFormat(fps=30, seconds=60.0, encode=_mp4),
    ".gif": VideoFormat(fps=10, seconds=20.0, encode=_gif, most=MAX_GIF_IMAGES),
}
