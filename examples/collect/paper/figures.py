"""Figures 11 to 14, the curves of the lessons, and Figure 15, as files and as the Markdown that shows them."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
from figure15 import passage
from logs import logs_of

from mindlang.pictures.curves import figure, image
from mindlang.pictures.learning_log import load_curves

Say = Callable[[str], None]

CURVES = {
    "figure11": ("collect.mind", ("GoToObject", "GoToDropZone")),
    "figure12": ("avoid_longer.mind", ("Avoid",)),
    "figure13": ("collect.mind", ("GoToObject+Avoid", "GoToDropZone+Avoid")),
    "figure14": ("collect.mind", ("Collect",)),
}


def draw(folder: Path, out: Path, say: Say) -> str:
    """Write the figures into `out`/figures; the Markdown that shows them."""
    (out / "figures").mkdir(exist_ok=True)
    shown = [_curves(folder, out / "figures", name, say) for name in CURVES]
    say("figure15: an obstacle passed by influence")
    if (passed := passage(folder)) is None:
        shown.append("Figure 15 is not drawn: constant_skills.mind is not taught here, or it passed no obstacle.")
    else:
        cv2.imwrite(str(out / "figures" / "figure15.png"), passed)
        shown.append("![An obstacle passed by influence, in five steps](figures/figure15.png)")
    return "\n\n".join(shown)


def _curves(folder: Path, out: Path, name: str, say: Say) -> str:
    file, lessons = CURVES[name]
    logs = logs_of(folder, file)
    paths = [logs[lesson].curve for lesson in lessons if lesson in logs]
    if not paths:
        return f"{name.capitalize()} is not drawn: {file} is not taught here."
    say(f"{name}: {' and '.join(lessons)}")
    drawn = figure([replace(curve, name=curve.path.parent.name, note="") for curve in load_curves(paths)])
    for suffix in (".svg", ".png"):
        (out / f"{name}{suffix}").write_bytes(image(drawn, suffix))
    return f"![{', '.join(lessons)}: score by generation](figures/{name}.svg)"
