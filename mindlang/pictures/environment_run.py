"""What an environment draws of a run in it, in the size and the colours of a page."""

import cv2
import numpy as np
from mindrun.errors import MindError
from mindrun.sim.outside.seen import UNKNOWN_FAILURES, SeenEpisode
from numpy.typing import NDArray

from mindlang.pictures.canvas import Image, blank, pasted
from mindlang.pictures.theme import Colour
from mindlang.run.recorded_run import RecordedRun


def seen_run(run: RecordedRun, seed: int) -> SeenEpisode:
    """The images of a run of that seed; MindError where its environment cannot be made to be seen."""
    acting = run.commands if run.acting is None else run.acting
    if run.task.fails and run.acting is None:
        raise MindError(UNKNOWN_FAILURES, "mindc run --picture and --video draw such a run")
    environment, folder = run.task.scene.environment, run.setup.folder
    return SeenEpisode(run.graph, environment, folder, seed, lambda first, last: acting[first:last])


def fitted(seen: NDArray[np.uint8], width: int, height: int, around: Colour) -> Image:
    """What was seen, red first, as an image of that size: as large as fits, in the middle."""
    high, wide, _ = seen.shape
    scale = min(width / wide, height / high)
    size = max(1, round(wide * scale)), max(1, round(high * scale))
    how = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    inner = cv2.resize(np.ascontiguousarray(seen[:, :, ::-1]), size, interpolation=how)
    page = blank(width, height, around)
    pasted(page, inner.astype(np.uint8), (width - size[0]) // 2, (height - size[1]) // 2)
    return page
