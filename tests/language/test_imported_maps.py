"""Files of other programs as maps: what is wall there is wall here, and what cannot be read is said in a sentence."""

import struct
from collections.abc import Callable
from itertools import product
from pathlib import Path

import cv2
import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st
from mindrun.kinds.things.map import Map

from mindlang.cli import commands
from mindlang.compiler.compile import load
from mindlang.maps.map_text import MapError
from mindlang.maps.maze_drawing import read_maze
from mindlang.maps.ros_map import read_ros_map
from tests.language.examples import ROOT

MAZE = """
  o---o---o
  | G   b |
  o   o---o
  | S     |
  o---o---o
"""
YAML = "image: {}\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
MIND = """\
tick 1/60 s
master Go
body Robot is disc size 2
actuator left is wheel side left neutral 0.5
sensor near is bearing of goal
skill Go is mlp
  reads near
  drives left
{}
task Find in Walled
  lasts 60 ticks
"""
Walls = st.lists(st.lists(st.booleans(), min_size=6, max_size=6), min_size=5, max_size=5)


@given(level=Walls, upright=Walls, post=st.sampled_from("+o"), wide=st.integers(2, 5), high=st.integers(2, 3))
def test_a_wall_is_where_it_is_drawn(
    tmp_path_factory: pytest.TempPathFactory, level: list[list[bool]], upright: list[list[bool]],
    post: str, wide: int, high: int,
) -> None:  # fmt: skip
    lines = []
    for row in range(5):
        lines.append(post + "".join(" -"[is_wall] * (wide - 1) + post for is_wall in level[row][:4]))
        between = "".join(" |"[is_wall] + " " * (wide - 1) for is_wall in upright[row][:5])
        lines += [between] * (high - 1) if row < 4 else []
    path = tmp_path_factory.mktemp("maze") / "maze.txt"
    path.write_text("\n".join(lines))
    found = read_maze(path).lines
    assert len(found) == len(found[0]) == 4 * wide + 1
    for (row, column), step in product(product(range(5), range(4)), range(1, wide)):
        assert (found[row * wide][column * wide + step] == "#") == level[row][column]
    for (row, column), step in product(product(range(4), range(5)), range(1, wide)):
        assert (found[row * wide + step][column * wide] == "#") == upright[row][column]


def test_a_maze_is_a_mind_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "maze.txt").write_text(MAZE)
    done = CliRunner().invoke(commands, ["import", "map", "maze.txt", "-o", "walls.txt"], catch_exceptions=False)
    assert done.exit_code == 0
    source = "\n".join(line for line in done.stderr.splitlines() if line.startswith(("unit", "scene", "  ")))
    (tmp_path / "main.mind").write_text(MIND.format(source))
    compiled = load("main.mind")
    assert compiled.diagnostics == ()
    [task] = compiled.whole[1].tasks
    assert task.start.at == pytest.approx((-2, -2))
    assert {thing.name: thing.kind.at[0] for thing in task.things if thing.name != "walls"} == {
        "b": pytest.approx((2, 2)), "goal": pytest.approx((-2, 2)),
    }  # fmt: skip


def saved(folder: Path, pixels: np.ndarray, name: str = "hall.pgm") -> Path:
    (folder / "hall.yaml").write_text(YAML.format(name))
    cv2.imwrite(str(folder / name), pixels)
    return folder / "hall.yaml"


@pytest.mark.parametrize("name", ["hall.pgm", "hall.png"])
def test_a_map_of_ros_is_cut_to_what_is_known(tmp_path: Path, name: str) -> None:
    pixels = np.full((40, 60), 205, np.uint8)
    pixels[10:20, 30:45] = 0
    pixels[11:19, 31:44] = 254
    pixels[12, 33] = 0
    found = read_ros_map(saved(tmp_path, pixels, name))
    assert found.lines[:4] == ("#" * 15, "#" + "." * 13 + "#", "#..#" + "." * 10 + "#", "#" + "." * 13 + "#")
    assert (len(found.lines), found.cell) == (10, pytest.approx(0.05))
    assert f"0 0 of the world is {-1 + 0.05 * 37.5:.3f} {2 + 0.05 * 25:.3f} m of the map" in found.said


def test_a_large_map_of_ros_becomes_coarser_and_loses_no_wall(tmp_path: Path) -> None:
    pixels = np.full((500, 700), 254, np.uint8)
    pixels[:, 333] = 0
    found = read_ros_map(saved(tmp_path, pixels))
    assert found.fits
    walls = Map(found.lines, found.cell).walls
    for row in range(500):
        y = 0.05 * (250 - row - 0.5)
        assert any(wall.holds((0.05 * (333.5 - 350), y)) for wall in walls)


def as_yaml(said: str) -> Callable[[Path], Path]:
    def made(folder: Path) -> Path:
        path = saved(folder, np.full((4, 4), 254, np.uint8))
        path.write_text(said)
        return path

    return made


def as_picture(data: bytes, name: str = "hall.pgm") -> Callable[[Path], Path]:
    def made(folder: Path) -> Path:
        path = saved(folder, np.full((4, 4), 254, np.uint8), name)
        (folder / name).write_bytes(data)
        return path

    return made


FOUR = struct.pack(">II", 4, 4)
BOMB = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBBI", 13, b"IHDR", 60000, 60000, 8, 0, 0, 0, 0, 0)
WRONG = {
    "no YAML": as_yaml("a: ["),
    "is no map of ROS: Expected": as_yaml("- 1"),
    "required field `free_thresh`": as_yaml(YAML.format("hall.pgm").replace("free_thresh", "free")),
    r"0.0001 - at `\$.resolution`": as_yaml(YAML.format("hall.pgm").replace("0.05", ".nan")),
    "free_thresh is above": as_yaml(YAML.format("hall.pgm").replace("0.65", "0.1")),
    "invalid|Invalid": as_yaml(YAML.format("hall.pgm") + "mode: raw\n"),
    "gone.pgm cannot be read: No such file": as_yaml(YAML.format("gone.pgm")),
    "cannot be read: embedded null byte": as_yaml(YAML.format('"a\\0b.pgm"')),
    "no pixel of hall.pgm is free": as_yaml(YAML.format("hall.pgm").replace("negate: 0", "negate: 1")),
    "60000 x 60000 pixels": as_picture(BOMB, "hall.png"),
    "100000 x 100000 pixels": as_picture(b"P5 100000 100000 255\n"),
    "hall.pgm is damaged": as_picture(b"P5 4 4 255\n123"),
    "hall.png is damaged": as_picture(BOMB.replace(BOMB[16:24], FOUR), "hall.png"),
    "is no picture": as_picture(b"GIF89a"),
}  # fmt: skip


@pytest.mark.parametrize("said", WRONG)
def test_one_sentence_for_a_map_of_ros_that_is_none(tmp_path: Path, said: str) -> None:
    with pytest.raises(MapError, match=said):
        read_ros_map(WRONG[said](tmp_path))


@pytest.mark.parametrize(
    ("said", "text"),
    [
        ("larger than 1 MiB", "+---+\n" * 200_000),
        ("no drawing", "#####\n#...#\n#####\n"),
        ("'3' in line 3, column 3", "\n+---+\n| 3 |\n+---+\n"),
        ("'x' in line 1, column 3", "+-x-+\n|   |\n+---+\n"),
        ("'a' in line 4, column 1", "+---+\n|   |\n+---+\na\n"),
        (r"ab in one cell \(line 2, column 2\)", "+---+\n|a b|\n+---+\n"),
    ],
)
def test_one_sentence_for_a_maze_that_is_none(tmp_path: Path, said: str, text: str) -> None:
    (tmp_path / "maze.txt").write_text(text)
    with pytest.raises(MapError, match=said):
        read_maze(tmp_path / "maze.txt")


@pytest.mark.parametrize(
    ("file", "walls"),
    [("maze.txt", "walls.txt"), ("practice.txt", "practice_walls.txt"), ("hall.yaml", "hall_walls.txt")],
)
def test_the_maps_of_the_example_are_those_that_are_imported(file: str, walls: str) -> None:
    folder = ROOT / "examples" / "micromouse"
    found = (read_ros_map if file.endswith("yaml") else read_maze)(folder / file)
    assert (folder / walls).read_text(encoding="utf-8").splitlines() == [*found.lines]
