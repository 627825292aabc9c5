"""The images of a film whose world is an environment: what that draws, beside the hierarchy."""

from mindlang.pictures.canvas import Image, Viewport
from mindlang.pictures.environment_run import fitted, seen_run
from mindlang.pictures.film_images import FilmImages
from mindlang.pictures.names import Label
from mindlang.pictures.theme import NIGHT


class EnvironmentFilmImages(FilmImages):
    """As `FilmImages`; MindError where the environment draws nothing."""

    def ratio(self) -> float:
        """How many times as wide as high what it draws is."""
        self._seen = seen_run(self._run, self._found["seed"])
        height, width, _ = self._seen.image(0).shape
        return float(width / height)

    def _world(self, tick: int, has_ended: bool = False) -> Image:
        return fitted(self._seen.image(tick), *self.layout.world, NIGHT.page)

    def _occupied(self, view: Viewport) -> list[Label]:
        """Nobody knows."""
        return []
