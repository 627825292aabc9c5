"""A small hierarchy with weights in its lock, as if it had been taught."""

from pathlib import Path

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.weights import genes

from mindlang.compiler.compile import load
from mindlang.lock import Taught, lock_path, read_lock, read_locks
from mindlang.lock.blobs import record
from mindlang.lock.signature import arrange
from mindlang.lock.status import Status, key_of_taught, status
from mindlang.lock.training_world import TrainingWorld
from mindlang.lock.world_facts import Worlds
from tests.lint.minds import WORLD

MIND = """\
# Two skills and one above them.
tick 1/60 s
master Drive
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor eye is range_finder at 0 30 330 deg
sensor ball_bearing is bearing of ball
sensor charge is battery
memory mood is cell decay 0.9

skill Go is mlp hidden 1  # to the ball
  reads ball_bearing
  drives left_wheel
  drives right_wheel

skill Avoid is mlp hidden 2
  reads eye
  drives left_wheel
  drives right_wheel
  drives mood

skill Drive is mlp hidden 2
  reads ball_bearing
  reads eye
  influences Go
  influences Avoid
  influences Grab at 1

skill Grab is rule
  drives claw at 1

task Roam in plain
  contains ball is item size 2 reached moves
  lasts 60 ticks
  rewards 10 on reach of ball

curriculum School is genetic population 8
  teaches Go on Roam for 3 generations
  teaches Avoid on Roam for 3 generations
  teaches Drive on Roam for 3 generations
"""


def write_mind(folder: Path, text: str = MIND) -> Path:
    """The mind as a file."""
    path = folder / "drive.mind"
    path.write_bytes(text.encode())
    return path


def teach(path: Path, *skills: str, seed: int = 1, lock: Path | None = None) -> None:
    """Random weights for these skills, or all that learn, base skills first, recorded with those below them."""
    graph = load(path).graph
    assert graph
    graph = arrange(graph, {})
    rng, weights = np.random.default_rng(seed), {}
    tasks = {lesson.skill: lesson.task for lesson in reversed(graph.lessons)}
    worlds = {lesson.skill: Worlds(graph, path.parent).of(lesson) for lesson in reversed(graph.lessons)}
    for skill in reversed(graph.skills):
        if genes(skill) and not skill.like and (skill.name in skills or not skills):
            weights[skill.name] = rng.uniform(-0.7, 1, genes(skill)).astype(np.float32)
            task = tasks.get(skill.name, "Roam")
            taught = Taught(task, skill.name, False, 3, 8, seed, 1.5)
            learnt = {skill.name: weights[skill.name]}
            world = worlds.get(skill.name) or world_in(graph, taught)
            record(lock or lock_path(path), graph, learnt, taught, weights, world)


def world_in(graph: Graph, taught: Taught) -> TrainingWorld:
    """The world in which a mind would teach so, whatever its lessons say; some other where it has no such task."""
    key = key_of_taught(taught)
    said = {"task": key.task, "master": key.master, "with_subskills": key.jointly, "from_scratch": False}
    is_known = key.task in {task.name for task in graph.tasks} and key.master in graph.skill_numbers
    return Worlds(graph, None).of_gone(key, {**said, "learner": {"is": "genetic"}}) if is_known else WORLD


def statuses(path: Path) -> dict[str, Status]:
    """How the skills of a file stand."""
    compiled = load(path)
    assert compiled.graph
    lock = read_locks([source.path for source in compiled.sources])
    return status(arrange(compiled.graph, lock), lock)


def recorded(path: Path, skill: str = "Go") -> str:
    """The hash of the weights that a mind's lock names for a skill."""
    return read_lock(lock_path(path))[skill].weights
