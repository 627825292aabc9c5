"""Who may import whom: the compiler imports what runs, never back, and the robot needs numpy alone."""

import ast
import json
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Mapping
from graphlib import TopologicalSorter
from itertools import chain
from pathlib import Path

from tests.project.sources import COMPILER, ROOT, RUNTIME, arrows, imported, modules, nodes, package

OUR_OWN = {"mindlang", "mindrun"}
# whose names differ from what is imported
MODULES = {
    "dask-jobqueue": "dask_jobqueue",
    "opencv-python-headless": "cv2",
    "pillow": "PIL",
    "pyyaml": "yaml",
    "stable-baselines3": "stable_baselines3",
}
WORKSTATION = {"numba", "llvmlite", "packaging", "pymunk", "cv2"}
SIM = RUNTIME / "sim"


def foreign(files: Iterable[Path]) -> dict[str, set[str]]:
    """For each file that imports something of neither Python nor this project: what."""
    found = {str(path.relative_to(ROOT)): {package(name) for name in imported(path)} for path in files}
    ours = OUR_OWN | sys.stdlib_module_names
    return {path: names - ours for path, names in found.items() if names - ours}


def loaded_by(*said: str) -> set[str]:
    """The packages that some `mindc` commands have loaded when they end."""
    program = f"""
import json, sys
from mindlang.cli import commands
for words in {said!r}:
    try:
        commands.main(words.split(), standalone_mode=False)
    except SystemExit:
        pass
print(json.dumps(sorted(sys.modules)))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=ROOT)
    return {package(name) for name in json.loads(done.stdout.splitlines()[-1])}


def test_the_runtime_never_imports_the_compiler() -> None:
    assert [path for path in modules(RUNTIME) if "mindlang" in {package(name) for name in imported(path)}] == []


def test_no_arrow_runs_back_up() -> None:
    """Neither files nor folders import each other in a circle: in every folder, what is in it has an order."""
    found = arrows(COMPILER, RUNTIME)
    static_order(found)
    folders = {name.rpartition(".")[0] for name in found} - {""}
    for folder in folders:
        inside = {name: part(name, folder) for name in found if name.startswith(f"{folder}.")}
        rooms: dict[str, set[str]] = {room: set() for room in inside.values()}
        for name, room in inside.items():
            rooms[room] |= {inside[other] for other in found[name] & inside.keys()} - {room}
        static_order(rooms)


def part(name: str, folder: str) -> str:
    """Which of the files and folders in a folder a module is in."""
    return name.removeprefix(f"{folder}.").partition(".")[0]


def static_order(found: Mapping[str, Iterable[str]]) -> list[str]:
    """What is imported before what imports it; CycleError where there is no such order."""
    return [*TopologicalSorter(found).static_order()]


def test_the_robot_needs_numpy_alone() -> None:
    robot = [path for path in modules(RUNTIME) if not path.is_relative_to(SIM)]
    assert {name for names in foreign(robot).values() for name in names} == {"numpy"}


def test_only_the_simulated_world_needs_a_workstation() -> None:
    allowed = WORKSTATION | {"numpy"}
    assert {path: names - allowed for path, names in foreign(modules(SIM)).items() if names - allowed} == {}


def test_the_robot_never_imports_the_simulated_world() -> None:
    names = RUNTIME / "__init__.py"  # imports what is asked for alone: tests/api/test_public.py
    robot = [path for path in modules(RUNTIME) if not path.is_relative_to(SIM) and path != names]
    assert [path for path in robot if any(name.startswith("mindrun.sim") for name in imported(path))] == []


def test_weights_are_put_beside_a_graph_in_few_places() -> None:
    """Where the graph is `arrange`d for them, they were taught in its order, or there are none; others take both."""
    places = {
        "mindlang/lock/status.py": "arranged here",
        "mindlang/run/setup.py": "the arranged ones, and zeros beside them",
        "mindlang/editing/verify.py": "arranged there, before and after an edit",
        "mindlang/training/subject.py": "arranged here",
        "mindlang/weights/importing.py": "a lesson of a subject, which is arranged",
        "mindlang/training/taught_runs.py": "those of a run, if its mind has them in the order of the subject",
        "mindlang/training/teaching.py": "a run has those of its subject, which is arranged",
        "mindlang/training/retention.py": "a lesson of a subject, which is arranged",
        "mindlang/propose/trial.py": "arranged there, for each candidate",
        "mindlang/testing.py": "drawn there for its graph, in its order",
        "mindlang/view/learning.py": "a run has those of its mind, which is arranged",
        "runtime/mindrun/graph/bundle.py": "a bundle has both, sealed",
        "runtime/mindrun/sim/commanded_lanes.py": "none",
        "mindlang/audit/probes.py": "those of the audited mind, to which a skill without any is added",
        "mindlang/environments/episodes.py": "none",
        "mindlang/physics_check.py": "none",
        "mindlang/environments/live_view.py": "those of an agent, but for the skill that a program plays",
    }
    made = {
        path.relative_to(ROOT).as_posix()
        for path in modules(COMPILER, RUNTIME)
        for node in nodes(path)
        if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] == "Policy"
    }
    assert made == set(places)


def test_only_commands_know_the_command_line() -> None:
    assert [path for path in modules(RUNTIME) if "click" in {package(name) for name in imported(path)}] == []
    inner = [path for path in modules(COMPILER) if path.parent.name != "cli"]
    assert [path for path in inner if "click" in {package(name) for name in imported(path)}] == []


def test_what_is_imported_is_declared() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    used = (requirements for extra, requirements in extras.items() if extra != "dev")
    declared = [*project["dependencies"], *chain.from_iterable(used)]
    distributions = [requirement.split(">")[0] for requirement in declared]
    known = {MODULES.get(name, name) for name in distributions}
    assert {path: names - known for path, names in foreign(modules(COMPILER, RUNTIME)).items() if names - known} == {}


def test_only_curves_need_matplotlib() -> None:
    assert [file for file, names in foreign(modules(COMPILER)).items() if "matplotlib" in names] == [
        "mindlang/pictures/curves.py",
        "mindlang/pictures/training_plot.py",  # for its type, and once it is asked for
    ]


def test_help_loads_nothing_heavy() -> None:
    heavy = WORKSTATION | {"numpy", "lark", "rich", "yaml", "matplotlib"}
    assert loaded_by("--version", "--help", "check --help", "train --help", "plot --help") & heavy == set()


def test_check_loads_nothing_that_simulates() -> None:
    assert loaded_by("check examples/collect/collect.mind") & (WORKSTATION | {"numpy", "matplotlib", "yaml"}) == set()
