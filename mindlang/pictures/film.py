"""The film of a run: how long it is and what it shows when; each image is drawn by `film_images`."""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any, Never

from mindrun.files.atomic_write import destination, write

from mindlang.pictures.canvas import Image
from mindlang.pictures.environment_film import EnvironmentFilmImages
from mindlang.pictures.film_images import FilmImages
from mindlang.pictures.video_formats import FORMATS, VideoError, VideoFormat
from mindlang.run.recorded_run import RecordedRun

TRAIL_SECONDS = 8.0  # of the film for which the path stays
COLLISION_SECONDS = 0.7  # of the film for which a collision does
END_SECONDS = 3.0  # of the film for which the last image stays and says how the run ended


@dataclass(frozen=True, slots=True)
class Film:
    """A run at so many times the robot's speed."""

    run: RecordedRun
    found: dict[str, Any]
    speed: float
    format: VideoFormat

    @classmethod
    def of(cls, run: RecordedRun, found: dict[str, Any], speed: float | None, suffix: str = ".mp4") -> "Film":
        """A film for files that end in `suffix`.

        Without a speed one that shows the whole of the task's time in the seconds of its format, if that is not slower.
        """
        chosen, long = FORMATS[suffix], run.task.ticks * run.graph.tick
        return cls(run, found, speed or max(1.0, round(long / chosen.seconds, 1)), chosen)

    @property
    def step(self) -> float:
        """Ticks from one image to the next."""
        return self.speed / self.format.fps / self.run.graph.tick

    @property
    def moving(self) -> int:
        """How many images show the run; the last of them its last tick."""
        return int(-(-(self.run.ticks - 1) // self.step)) + 1

    @property
    def frames(self) -> int:
        """How many images the film has."""
        return self.moving + round(END_SECONDS * self.format.fps)

    @property
    def seconds(self) -> float:
        """How long it is."""
        return self.frames / self.format.fps

    def write(self, path: Path, wrote: Callable[[], None]) -> None:
        """Encode the film into `path`, which is only replaced when it is whole; `wrote` is told of each image."""
        if self.format.most and self.frames > self.format.most:
            self._refuse(path, self.format.most)
        place = destination(path)
        spare = place.with_name(f".{place.stem}.part{place.suffix}")
        try:
            self.format.encode(spare, Reel(self), self.format.fps, wrote)
            write(place, spare.read_bytes())
        except VideoError as error:
            raise VideoError(f"{path} cannot be written: {error}") from error
        finally:
            spare.unlink(missing_ok=True)

    def _refuse(self, path: Path, most: int) -> Never:
        """Raise VideoError: more images than `most`."""
        seconds = self.run.ticks * self.run.graph.tick
        fast = ceil(10 * seconds * self.format.fps / (most - round(END_SECONDS * self.format.fps) - 1)) / 10
        said = f"{path} would have {self.frames:,} images, and a {path.suffix} of more than {most} is too large"
        raise VideoError(said, f"--speed {fast:g} or faster, or a film: {path.with_suffix('.mp4').name}")


class Reel:
    """The images of a film by their numbers."""

    def __init__(self, film: Film) -> None:
        self._film = film
        trail, flash = (seconds * film.format.fps * film.step for seconds in (TRAIL_SECONDS, COLLISION_SECONDS))
        images = EnvironmentFilmImages if film.run.task.scene.environment else FilmImages
        self._images = images(film.run, film.found, film.speed, round(trail), flash)
        self._last: Image | None = None

    def __len__(self) -> int:
        return self._film.frames

    def __getitem__(self, number: int) -> Image:
        film = self._film
        if not 0 <= number < len(self):
            raise IndexError(number)
        if number < film.moving:
            return self._images.image(min(film.run.ticks, 1 + round(number * film.step)))
        if self._last is None:
            self._last = self._images.end()
        return self._last
