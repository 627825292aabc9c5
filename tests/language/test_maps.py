"""Maps drawn in characters: what they mean, and that a changed one is noticed."""

from itertools import product
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.policy import Policy
from mindrun.kinds.things.map import Map
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load
from mindlang.lock.world_changes import changes
from mindlang.lock.world_facts import Worlds
from mindlang.server.workspace import Workspace

MIND = """\
tick 1/60 s
master Go
body Robot is disc size 1
actuator left is wheel side left neutral 0.5
sensor near is bearing of gem
skill Go is mlp
  reads near
  drives left
task Find in arena size 40 30
  contains maze is map from "maze.txt" cell 4
  contains gem is item size 1
  contains dock is zone size 2
  lasts 60 ticks
  counts reach of gem
curriculum School is genetic
  teaches Go on Find for 3 generations
"""
MAZE = """\
#####
#g.d#
#.#g#
"""


def written(folder: Path, maze: str = MAZE) -> Path:
    (folder / "maze.txt").write_text(maze)
    (folder / "main.mind").write_text(MIND)
    return folder / "main.mind"


def test_walls_and_things_stand_where_they_are_drawn(tmp_path: Path) -> None:
    graph = load(written(tmp_path)).graph
    assert graph
    maze, gem, dock = (thing.kind for thing in graph.tasks[0].things)
    assert gem.at == ((-4.0, 0.0), (4.0, -4.0))
    assert gem.copies == 2
    assert dock.at == ((4.0, 0.0),)
    assert [tuple(wall) for wall in maze.walls] == [
        (0.0, 4.0, 10.0, 2.0), (-8.0, -2.0, 2.0, 4.0), (8.0, -2.0, 2.0, 4.0), (0.0, -4.0, 2.0, 2.0),
    ]  # fmt: skip


def test_every_run_has_them_and_the_robot_starts_on_the_floor(tmp_path: Path) -> None:
    graph = load(written(tmp_path)).graph
    assert graph
    rollout = Rollout(Policy(graph, {}), "Find", "Go", ["Go"])
    for seed in range(3):
        run = trace(rollout, seed)
        assert run.boxes.tolist() == [[*wall] for wall in graph.tasks[0].things[0].kind.walls]
        assert run.things[:, :2].tolist() == [[-4.0, 0.0], [4.0, -4.0], [4.0, 0.0]]


@given(st.lists(st.text("#.", min_size=4, max_size=4), min_size=1, max_size=6))
def test_rectangles_cover_the_walls_once_and_nothing_else(lines: list[str]) -> None:
    drawn = Map(tuple(lines), 2.0)
    for row, column in product(range(len(lines)), range(4)):
        x, y = 2 * (column - 1.5), 2 * ((len(lines) - 1) / 2 - row)
        assert sum(wall.holds((x, y)) for wall in drawn.walls) == (lines[row][column] == "#")


def test_a_changed_map_is_another_world(tmp_path: Path) -> None:
    def world(maze: str):  # type: ignore[no-untyped-def]
        graph = load(written(tmp_path, maze)).graph
        assert graph
        return Worlds(graph, None).of(graph.lessons[0])

    told = changes(world(MAZE), world(MAZE.replace("#g.d#", "#g#d#")))
    assert told == ["the text of maze has changed"]
    assert "gem" in " ".join(changes(world(MAZE), world(MAZE.replace("g#", ".#"))))


def test_an_editor_sees_a_changed_map(tmp_path: Path) -> None:
    main, workspace = written(tmp_path), Workspace()
    assert workspace.mind(main).compiled.graph
    written(tmp_path, MAZE.replace("d", "x"))
    assert not workspace.mind(main).compiled.graph


def test_the_robot_starts_at_s_unless_the_task_says_where(tmp_path: Path) -> None:
    main = written(tmp_path, MAZE.replace("g.d", "GSD"))
    for says, at in (("", (0.0, 0.0)), ("starts facing 90 deg", (0.0, 0.0)), ("starts at 1 0", (1.0, 0.0))):
        main.write_text(MIND.replace("cell 4\n", f"cell 4\n  {says}\n"))
        graph = load(main).graph
        assert graph
        assert graph.tasks[0].start.at == at
