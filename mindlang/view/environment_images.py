"""What an environment draws of a run that is seen, as text that a page shows as it comes."""

from __future__ import annotations

import base64
from collections.abc import Callable
from functools import partial
from pathlib import Path

import cv2
import numpy as np
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.sim.outside.seen import UNKNOWN_FAILURES, SeenEpisode, Sent
from numpy.typing import NDArray

Drawing = Callable[[Sent], SeenEpisode]
Image = NDArray[np.uint8]


def drawing_of(graph: Graph, task: Task | None, folder: Path, seed: int) -> Drawing | None:
    """What draws the run of a task; None where its world is no environment."""
    if task is None or not task.scene.environment:
        return None
    return _undrawn if task.fails else partial(SeenEpisode, graph, task.scene.environment, folder, seed)


def _undrawn(sent: Sent) -> SeenEpisode:
    raise MindError(UNKNOWN_FAILURES, "mindc run --picture and --video draw such a run")


def data_url(image: Image, kind: str, quality: tuple[int, ...] = ()) -> str:
    """An image [height, width, 3], red first, as an address that a page takes it from; `kind` is png or webp."""
    done, data = cv2.imencode(f".{kind}", image[:, :, ::-1], quality)
    assert done
    return f"data:image/{kind};base64,{base64.b64encode(bytes(data)).decode()}"
