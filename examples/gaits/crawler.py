"""A crawler on four legs, seen from above, as an environment of Gymnasium: feet that are down push it, others swing."""

from collections.abc import Sequence
from math import atan2, cos, hypot, pi, sin
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray
from PIL import Image, ImageDraw

STEP_SECONDS = 1 / 20
FOOT_RATE, BODY_SHARE = 4.0, 0.5  # how fast a foot moves, and how far the body, by one of foot
SIDE_FEET, DIAGONAL_FEET = ((0, 2), (1, 3)), ((0, 3), (1, 2))  # of front left, front right, hind left, hind right
HIP_PLACES = (1, 1), (1, -1), (-1, 1), (-1, -1)
BODY_WIDTH, NEAR_UNITS = 2.0, 1.0
BODY_OUTLINE = (1.4, 0.0), (1.0, 0.7), (-1.0, 0.7), (-1.0, -0.7), (1.0, -0.7)
SIDE_PIXELS, UNIT_PIXELS = 320, 16

Place = tuple[float, float]


class Crawler(gymnasium.Env[NDArray[np.float64], NDArray[np.float64]]):
    """Four legs, and a flag to go to.

    Observed are where the feet are, −1 hindmost, in which direction the flag is, 1 behind on the right, and the speed.
    An action has how fast each foot goes forward, and which of them are up: those above 0.
    """

    def __init__(self, render_mode: str | None = None) -> None:
        self.metadata = {"render_modes": ["rgb_array"], "render_fps": 20}
        self.observation_space = Box(-1, 1, (6,), np.float64)
        self.action_space = Box(-1, 1, (8,), np.float64)
        self.render_mode = render_mode

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[NDArray[np.float64], dict[str, Any]]:
        """Stand in the middle, facing along x; the flag is anywhere around it."""
        super().reset(seed=seed)
        self.feet, self.up = [0.0] * 4, [False] * 4
        self.x = self.y = self.heading = self.speed = 0.0
        self.track: list[Place] = []
        self._place()
        return self._seen(), {}

    def _place(self) -> None:
        way, far = self.np_random.uniform(-pi, pi), self.np_random.uniform(5, 10)
        self.flag = self.x + far * cos(way), self.y + far * sin(way)

    def _away(self) -> Place:
        return self.flag[0] - self.x, self.flag[1] - self.y

    def _seen(self) -> NDArray[np.float64]:
        dx, dy = self._away()
        turn = (atan2(dy, dx) - self.heading + pi) % (2 * pi) - pi
        return np.array([*self.feet, -turn / pi, self.speed / (FOOT_RATE * BODY_SHARE)])

    def step(self, action: NDArray[np.float64]) -> tuple[NDArray[np.float64], float, bool, bool, dict[str, Any]]:
        """Push with the feet that are down, where it stands on them: on three, or on two across from another."""
        swing, self.up = action[:4].tolist(), [lift > 0 for lift in action[4:].tolist()]
        down = [i for i in range(4) if not self.up[i]]
        stands = len(down) > 2 or tuple(down) in DIAGONAL_FEET
        pushed = [self._side([i for i in side if i in down], swing) if stands else 0.0 for side in SIDE_FEET]
        for i in range(4):
            rate = FOOT_RATE * swing[i] if self.up[i] else -pushed[i % 2]
            self.feet[i] = min(max(self.feet[i] + STEP_SECONDS * rate, -1.0), 1.0)
        left, right = (BODY_SHARE * each for each in pushed)
        self.speed = (left + right) / 2
        before = hypot(*self._away())
        self.heading += STEP_SECONDS * (right - left) / BODY_WIDTH
        self.x += STEP_SECONDS * self.speed * cos(self.heading)
        self.y += STEP_SECONDS * self.speed * sin(self.heading)
        self.track.append((self.x, self.y))
        after = hypot(*self._away())
        if after < NEAR_UNITS:
            self._place()
        return self._seen(), before - after + 10 * (after < NEAR_UNITS), False, False, {}

    def _side(self, down: Sequence[int], swing: Sequence[float]) -> float:
        """How fast the feet of a side push: their mean, and none where one of them is at its end."""
        rate = -FOOT_RATE * sum(swing[i] for i in down) / max(len(down), 1)
        return 0.0 if any(self.feet[i] * rate <= -abs(rate) for i in down) else rate

    def render(self) -> Any:
        """Draw it in the middle of a picture, with its track; feet that are down are filled."""
        image = Image.new("RGB", (SIDE_PIXELS, SIDE_PIXELS), "white")
        draw = ImageDraw.Draw(image)

        def at(x: float, y: float) -> Place:
            return SIDE_PIXELS / 2 + UNIT_PIXELS * (x - self.x), SIDE_PIXELS / 2 - UNIT_PIXELS * (y - self.y)

        def of_body(ahead: float, aside: float) -> Place:
            c, s = cos(self.heading), sin(self.heading)
            return at(self.x + c * ahead - s * aside, self.y + s * ahead + c * aside)

        def disc(place: Place, radius: float, fill: str) -> None:
            x, y, r = *place, UNIT_PIXELS * radius
            draw.ellipse((x - r, y - r, x + r, y + r), fill, "black", 2)

        disc(at(*self.flag), NEAR_UNITS, "#5fb37f")
        draw.line([at(*place) for place in self.track], "#8ab4e0", 3)
        draw.polygon([of_body(*corner) for corner in BODY_OUTLINE], "#20242c")
        for (ahead, aside), foot, up in zip(HIP_PLACES, self.feet, self.up, strict=True):
            place = of_body(ahead + BODY_SHARE * foot, 1.2 * aside)
            draw.line([of_body(ahead, 0.7 * aside), place], "#20242c", 4)
            disc(place, 0.22, "white" if up else "#e05a4f")
        return np.asarray(image)


gymnasium.register("Crawler-v0", Crawler)
