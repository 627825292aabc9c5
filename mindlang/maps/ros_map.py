"""Maps of ROS: a YAML file as map_server reads it, and the picture beside it, PGM or PNG, a pixel a place."""

import re
from math import ceil, degrees
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import yaml
from mindrun.kinds.things.map import FLOOR, WALL
from msgspec import Meta, Struct, ValidationError, convert
from numpy.typing import NDArray

from mindlang.maps.map_text import METRE_CM, MapError, MapText, data_of

MAX_YAML_BYTES = 64 << 10
MAX_IMAGE_BYTES = 64 << 20
MAX_PIXELS = 1 << 24  # 4096 by 4096; a file of a few bytes may say that it has more
MAX_SQUARE_PIXELS = 64  # along a side
PGM = re.compile(rb"P([25])(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,5})\s")
PNG = re.compile(rb"\x89PNG\r\n\x1a\n.{4}IHDR(.{4})(.{4})", re.S)
FORM = "A map of ROS has image, resolution, origin, negate, occupied_thresh, free_thresh."

Share = Annotated[float, Meta(ge=0, le=1)]
Coordinate = Annotated[float, Meta(ge=-1e6, le=1e6)]


class RosMap(Struct, frozen=True):
    """The YAML file of a map: a pixel is `resolution` metres wide, the lower left one at `origin`, with an angle."""

    image: Annotated[str, Meta(min_length=1)]
    resolution: Annotated[float, Meta(ge=1e-4, le=100)]
    origin: tuple[Coordinate, Coordinate, Coordinate]
    negate: Literal[0, 1]
    occupied_thresh: Share
    free_thresh: Share
    mode: Literal["trinary", "scale"] = "trinary"


def read_ros_map(path: Path) -> MapText:
    """The map that a YAML file of ROS describes; MapError says what is wrong with it, or with its picture."""
    said = _yaml(path)
    if said.free_thresh > said.occupied_thresh:
        raise MapError(f"{path}: free_thresh is above occupied_thresh, so a pixel could be both.")
    brightness = _brightness(path.parent / said.image)
    dark = brightness if said.negate else 1 - brightness
    # Beyond its edge nothing is known.
    is_free, is_occupied = (np.pad(each, 1) for each in (dark < said.free_thresh, dark > said.occupied_thresh))
    if not is_free.any():
        hint = "Free is what is brighter than 1 - free_thresh; with negate 1 what is darker than free_thresh."
        raise MapError(f"{path}: no pixel of {said.image} is free.", hint)
    return _squares(path, said, is_free, is_occupied)


def _yaml(path: Path) -> RosMap:
    try:
        return convert(yaml.safe_load(data_of(path, MAX_YAML_BYTES)), RosMap, strict=False)
    except ValidationError as error:
        raise MapError(f"{path} is no map of ROS: {error}.", FORM) from error
    except (yaml.YAMLError, ValueError, RecursionError, OverflowError) as error:
        raise MapError(f"{path} is no YAML.", FORM) from error


def _brightness(path: Path) -> NDArray[np.float32]:
    """The brightness of each pixel, 0 to 1, the first row on top; its size is asked before anything is decoded."""
    data = data_of(path, MAX_IMAGE_BYTES, "The path of a picture is relative to the YAML file.")
    pgm, png = PGM.match(data), PNG.match(data)
    if not (found := pgm or png):
        raise MapError(f"{path} is no picture of a map.", "Convert it into PGM or PNG.")
    width, height = map(int, pgm.groups()[1:3]) if pgm else (int.from_bytes(each) for each in found.groups())
    if not 0 < width * height <= MAX_PIXELS:
        message = f"{path} has {width} x {height} pixels, and a map 1 to {MAX_PIXELS:,}."
        raise MapError(message, "Scale it down, and write the resolution that it has then.")
    pixels = _of_pgm(data, pgm, width * height) if pgm else _of_png(data)
    if pixels is None or pixels.size != width * height:
        raise MapError(f"{path} is damaged: it ends too early.", "Save the map again.")
    return pixels.reshape(height, width)


def _of_pgm(data: bytes, header: re.Match[bytes], size: int) -> NDArray[np.float32] | None:
    most, rest = int(header[4]), data[header.end() :]
    try:
        if header[1] == b"5":
            values = np.frombuffer(rest, ">u2" if most > 255 else np.uint8, size)
        else:
            values = np.array(rest.split()[:size], np.uint32)
    except (ValueError, OverflowError):  # too few, or no numbers
        return None
    return (values / np.float32(most or 1)).astype(np.float32)


def _of_png(data: bytes) -> NDArray[np.float32] | None:
    import cv2

    if b"IEND" not in data[-64:]:
        return None
    pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_GRAYSCALE)
    return None if pixels is None else (pixels / np.float32(255)).astype(np.float32)


def _squares(path: Path, said: RosMap, is_free: NDArray[np.bool_], is_occupied: NDArray[np.bool_]) -> MapText:
    """The map of squares that are as small as a world takes, of pixels with one more around them."""
    rows, columns = (np.flatnonzero(is_free.any(axis)) for axis in (1, 0))
    top, left, low, right = rows[0] - 1, columns[0] - 1, rows[-1] + 2, columns[-1] + 2  # with what is around it
    cut, metres = np.stack([is_free, is_occupied])[:, top:low, left:right], said.resolution
    for many in range(1, MAX_SQUARE_PIXELS + 1):
        high, wide = (ceil(each / many) for each in cut.shape[1:])
        filled = np.pad(cut, ((0, 0), (0, high * many - cut.shape[1]), (0, wide * many - cut.shape[2])))
        free, walls = filled.reshape(2, high, many, wide, many).sum((2, 4))
        floor = (walls == 0) & (2 * free >= many * many)
        if not floor.any():
            break
        lines = tuple("".join(FLOOR if each else WALL for each in row) for row in floor)
        x = said.origin[0] + metres * (left - 1 + wide * many / 2)
        y = said.origin[1] + metres * (is_free.shape[0] - 1 - top - high * many / 2)
        of = f"; one is wall where any of its {many} x {many} pixels is" if many > 1 else ""
        told = [
            f"{is_free.shape[1] - 2} x {is_free.shape[0] - 2} pixels of {METRE_CM * metres:g} cm; "
            f"what is free lies in {right - left - 2} x {low - top - 2} of them",
            f"{wide} x {high} squares of {METRE_CM * metres * many:g} cm{of}",
            f"0 0 of the world is {x:.3f} {y:.3f} m of the map",
        ]
        if unknown := int((~floor & (walls == 0)).sum()):
            told.append(f"{unknown} squares of which too little is known are walls")
        if said.origin[2]:
            told.append(f"the map is turned by {degrees(said.origin[2]):.4g} deg, the world is not")
        if (found := MapText(lines, metres * many, tuple(told))).fits:
            return found
    raise MapError(f"{path} has more walls than a world takes, however coarse.", "Cut a part out of it.")
