"""The film of a run: how long it is, what it shows when, and the files that it can become; `film_images` draws it.

They are mp4 by OpenCV, and GIF by Pillow, which a README shows without a player. OpenCV writes GIFs as well, but no
palette for all images: 150 images took it 7.0 s and 8.4 MB, Pillow 0.6 s and 6.7 MB.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from math import ceil
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from mindrun.errors import MindError
from mindrun.files.atomic_write import destination, write
from PIL import Image as Pillow

from mindlang.pictures.canvas import Image, reduced
from mindlang.pictures.film_images import FilmImages
from mindlang.run.recorded_run import RecordedRun

TRAIL_SECONDS = 8.0  # of the film for which the path stays
COLLISION_SECONDS = 0.7  # of the film for which a collision does
END_SECONDS = 3.0  # of the film for which the last image stays and says how the run ended
PALETTE_COLOURS = 255  # one of 256 is left for pixels that stay as they were
PALETTE_SAMPLES = 6  # images from which the colours of a GIF are taken
GIF_SCALE = 0.75  # of a film's width and height
MAX_GIF_IMAGES = 600  # all are in memory until they are written


class VideoError(MindError):
    """A video that cannot be encoded or written."""


@dataclass(frozen=True, slots=True)
class VideoFormat:
    """A format of films: images per second, the seconds of a whole run without a speed, and the encoder.

    `encode` writes a film to a file and tells of each image; it raises VideoError. `most` is how many it takes.
    """

    fps: int
    seconds: float
    encode: "Callable[[Path, Film, Callable[[], None]], None]"
    most: int | None = None


class Film:
    """A run at so many times the robot's speed, as images by their numbers from 0: `moving` ones, then its end.

    It is for files that end in `suffix`. Without a speed it shows the whole of the task's time in the seconds of its
    format, if that is not slower.
    """

    def __init__(self, run: RecordedRun, found: dict[str, Any], speed: float | None, suffix: str = ".mp4") -> None:
        self.run, self.format = run, FORMATS[suffix]
        self.speed = speed or max(1.0, round(run.task.ticks * run.graph.tick / self.format.seconds, 1))
        self._found = found
        self._step = self.speed / self.format.fps / run.graph.tick  # ticks from one image to the next
        self.moving = int(-(-(run.ticks - 1) // self._step)) + 1
        self.seconds = len(self) / self.format.fps

    def __len__(self) -> int:
        return self.moving + round(END_SECONDS * self.format.fps)

    def __getitem__(self, number: int) -> Image:
        if number >= self.moving:
            return self._end
        return self._images.image(min(self.run.ticks, 1 + round(number * self._step)))

    @cached_property
    def _images(self) -> FilmImages:
        trail, flash = (seconds * self.format.fps * self._step for seconds in (TRAIL_SECONDS, COLLISION_SECONDS))
        return FilmImages(self.run, self._found, self.speed, round(trail), flash)

    @cached_property
    def _end(self) -> Image:
        return self._images.end()

    def write(self, path: Path, wrote: Callable[[], None]) -> None:
        """Encode the film into `path`, which is only replaced when it is whole; `wrote` is told of each image."""
        if self.format.most and len(self) > self.format.most:
            most, seconds = self.format.most, self.run.ticks * self.run.graph.tick
            fast = ceil(10 * seconds * self.format.fps / (most - round(END_SECONDS * self.format.fps) - 1)) / 10
            said = f"{path} would have {len(self):,} images, and a {path.suffix} of more than {most} is too large"
            raise VideoError(said, f"--speed {fast:g} or faster, or a film: {path.with_suffix('.mp4').name}")
        place = destination(path)
        spare = place.with_name(f".{place.stem}.part{place.suffix}")
        try:
            self.format.encode(spare, self, wrote)
            write(place, spare.read_bytes())
        except VideoError as error:
            raise VideoError(f"{path} cannot be written: {error}") from error
        finally:
            spare.unlink(missing_ok=True)


def _mp4(path: Path, film: Film, wrote: Callable[[], None]) -> None:
    height, width, _ = film[0].shape
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), film.format.fps, (width, height))
    try:
        if not writer.isOpened():
            raise VideoError("OpenCV cannot encode a video there")
        for number in range(len(film)):
            writer.write(film[number])
            wrote()
    finally:
        writer.release()
    if _images_in(path) != len(film):
        raise VideoError("it is not whole: is the disk full?")


def _images_in(path: Path) -> int:
    video = cv2.VideoCapture(str(path))
    count = int(video.get(cv2.CAP_PROP_FRAME_COUNT))
    video.release()
    return count


def _gif(path: Path, film: Film, wrote: Callable[[], None]) -> None:
    """Encode a GIF with one palette for all images and no dithering: what does not move costs nothing."""
    samples = [_small(film[int(number)]) for number in np.linspace(0, len(film) - 1, PALETTE_SAMPLES)]
    palette = Pillow.fromarray(np.concatenate(samples)).quantize(PALETTE_COLOURS, dither=Pillow.Dither.NONE)

    def drawn() -> Iterator[Pillow.Image]:
        for number in range(len(film)):
            yield Pillow.fromarray(_small(film[number])).quantize(palette=palette, dither=Pillow.Dither.NONE)
            wrote()

    images = drawn()
    duration = round(1000 / film.format.fps)
    next(images).save(path, "GIF", save_all=True, append_images=chain(images), duration=duration, loop=0)


def _small(image: Image) -> Image:
    """An image as small as in a GIF, red first."""
    return np.ascontiguousarray(reduced(image, GIF_SCALE)[..., ::-1])


FORMATS = {
    ".mp4": VideoFormat(fps=30, seconds=60.0, encode=_mp4),
    ".gif": VideoFormat(fps=10, seconds=20.0, encode=_gif, most=MAX_GIF_IMAGES),
}
