"""Figures 11 to 14, the curves of the lessons, and Figure 15: an obstacle passed by influence, in five steps."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from logs import logs_of
from measure import compiled
from numpy.typing import NDArray

from mindlang.pictures.canvas import Image
from mindlang.pictures.curves import figure, image
from mindlang.pictures.film import HEIGHT, WIDTH, Film
from mindlang.pictures.log import load_curves
from mindlang.pictures.story import Story, tell
from mindlang.run import outcome
from mindlang.run.casting import CastingError, cast
from mindlang.run.stage import NOBODY

Say = Callable[[str], None]

CURVES = {
    "figure11": ("collect.mind", ("GoToObject", "GoToDropZone")),
    "figure12": ("avoid_longer.mind", ("Avoid",)),
    "figure13": ("collect.mind", ("GoToObject+Avoid", "GoToDropZone+Avoid")),
    "figure14": ("collect.mind", ("Collect",)),
}
STEPS = 5
NEAR, FAR = 60, 240  # ticks: the shortest and the longest passage of an obstacle that is shown
LOOK = 30  # ticks shown before Dodge has any influence, and after it has lost it
SEEDS = range(1, 21)


def draw(folder: Path, out: Path, say: Say) -> str:
    """Write the figures into `out`/figures; the Markdown that shows them."""
    (out / "figures").mkdir(exist_ok=True)
    shown = []
    for name, (file, lessons) in CURVES.items():
        logs = logs_of(folder, file)
        paths = [logs[lesson].curve for lesson in lessons if lesson in logs]
        if paths:
            say(f"{name}: {' and '.join(lessons)}")
            curves = [replace(curve, name=curve.path.parent.name) for curve in load_curves(paths)]
            drawn = figure(curves)
            for suffix in (".svg", ".png"):
                (out / "figures" / f"{name}{suffix}").write_bytes(image(drawn, suffix))
            shown.append(f"![{', '.join(lessons)}: score by generation](figures/{name}.svg)")
    say("figure15: an obstacle passed by influence")
    if (passed := passage(folder)) is not None:
        cv2.imwrite(str(out / "figures" / "figure15.png"), passed)
        shown.append("![Five steps of passing an obstacle](figures/figure15.png)")
    return "\n\n".join(shown)


@dataclass(frozen=True, slots=True)
class Passage:
    """The ticks of a story in which Dodge takes over from SeekObject, and gives back what it took."""

    film: Film
    first: int
    last: int

    @property
    def steps(self) -> NDArray[np.int64]:
        """Five ticks, from before to after."""
        return np.linspace(self.first - LOOK, self.last + LOOK, STEPS).astype(np.int64)


def passage(folder: Path) -> Image | None:
    """The five steps as one picture, the world at the left, the hierarchy at the right; None where there are none."""
    path = folder / "constant_skills.mind"
    try:
        found = cast(str(path), compiled(path), "Collect", "Gather")
    except CastingError:
        return None
    rollout = found.rollout()
    for seed in SEEDS:
        story = tell(found, rollout, seed)
        for first, last in passages(story):
            scores = rollout.score(NOBODY, [seed])
            about = {"seed": seed, **outcome.one(found.task, scores)}
            return _strip(Passage(Film.of(story, about, 1.0), first, last))
    return None


def passages(story: Story) -> Iterator[tuple[int, int]]:
    """The first and the last tick of each time in which Dodge had more influence than SeekObject, and no collision."""
    names = [skill.name for skill in story.graph.skills]
    dodge, seek = (story.influence[:, names.index(name)] for name in ("Dodge", "SeekObject"))
    edges = np.flatnonzero(np.diff(np.concatenate([[0], (dodge > seek).astype(np.int8), [0]])))
    for first, last in edges.reshape(-1, 2):
        around = slice(max(0, first - 2 * LOOK), last + 2 * LOOK)
        calm = not story.touching[around].any() and (story.held[around] < 0).all()
        if NEAR <= last - first <= FAR and first > 2 * LOOK and last + 2 * LOOK < story.ticks and calm:
            yield int(first), int(last)


def _strip(passed: Passage) -> Image:
    """The frames one below the other: what is around the robot, and beside it the hierarchy."""
    from mindlang.pictures.panel import Panel
    from mindlang.pictures.path import Path as Trail
    from mindlang.pictures.theme import NIGHT

    story = passed.film.story
    panel = Panel(story, NIGHT, HEIGHT + 8, 86, WIDTH - HEIGHT - 16, HEIGHT - 96)
    trail = Trail.of(story, NIGHT)
    return np.concatenate([passed.film.frame(panel, trail, int(tick)) for tick in passed.steps])
