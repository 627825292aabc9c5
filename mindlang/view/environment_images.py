"""What an environment draws of a run that is seen, as text that a page shows as it comes."""

from __future__ import annotations

import base64
from collections.abc import Callable
from functools import partial
from pathlib import Path

import cv2
from mindrun.graph import Graph, Task
from mindrun.sim.outside.seen import SeenEpisode, Sent

Drawing = Callable[[Sent], SeenEpisode]


def drawing_of(graph: Graph, task: Task | None, folder: Path, seed: int) -> Drawing | None:
    """What draws the run of a task; None where its world is no environment, or its rows do not say what has failed."""
    if task is None or not task.scene.environment or task.fails:
        return None
    return partial(SeenEpisode, graph, task.scene.environment, folder, seed)


def png_text(seen: SeenEpisode, tick: int) -> str:
    """The image after a tick, as PNG in base64; MindError where there is none."""
    done, data = cv2.imencode(".png", seen.image(tick)[:, :, ::-1])
    assert done
    return base64.b64encode(bytes(data)).decode()
