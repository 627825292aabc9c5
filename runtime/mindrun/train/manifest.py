"""The manifest of a run: what is taught, from what, with what; all that a resumed run is held to.

And the build that results depend on: the sources of mindrun, and the versions of what they compute with.
"""

import json
import platform
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from mindrun.errors import BundleError
from mindrun.files.strict_json import is_whole, parsed
from mindrun.graph.codec import decode_part, encode
from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.skill_sets import acting
from mindrun.graph.tasks import installed_version
from mindrun.graph.validate import lesson_flaws
from mindrun.graph.weights import Weights
from mindrun.kinds.environment import module_beside
from mindrun.kinds.functions.procedure import module_source
from mindrun.kinds.registry import brought_by
from mindrun.numbers.short_repr import full_repr
from mindrun.train import RunError

MANIFEST_VERSION = 4
COMPUTED_WITH = ("numpy", "numba", "pymunk")
SOURCES = Path(__file__).parents[1]
SHOWN_CHARACTERS = 12  # of a hash
MAX_SEED = 2**63 - 1  # seed

FORMS = {  # of the parts that are texts
    **dict.fromkeys(("mind", "source", "started", "processor"), str),
    **dict.fromkeys(("learners", "command"), list),
    **dict.fromkeys(("weights", "sources", "versions"), dict),
}

Build = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Manifest:
    """The inputs of a run, as SHA-256 hashes: `mind` of all that the lesson depends on, `weights` by skill.

    The genome has the weights of the `learners`, one after the other.
    `source` is the path of the main file, `sources` has the hash of each file of the mind, by path from the main one.
    """

    lesson: Lesson
    learners: tuple[str, ...]
    seed: int
    mind: str
    weights: Mapping[str, str]
    source: str
    sources: Mapping[str, str]
    command: tuple[str, ...]
    started: str
    versions: Mapping[str, str]
    processor: str

    @property
    def name(self) -> str:
        return self.lesson.name

    @property
    def identity(self) -> str:
        """A hash of what decides the result; a checkpoint is of this run if it carries it."""
        parts = (encode(self.lesson), self.learners, self.seed, self.mind, dict(self.weights))
        return _sha256(json.dumps(parts, sort_keys=True).encode())


def fingerprint(graph: Graph, lesson: Lesson, procedures: Path | None) -> str:
    """The SHA-256 of what a lesson depends on: its task, the skills under its master, the body, the modules beside."""
    tasks = tuple(task for task in graph.tasks if task.name == lesson.task)
    skills = acting(graph, tasks[0], lesson.master)
    # To freeze a skill changes the lesson of no other.
    thawed = tuple(replace(skill, frozen=False) for skill in graph.skills)
    scope = replace(graph, master=lesson.master, skills=thawed, tasks=tasks, lessons=())
    code = [
        module_source(skill.function.calls, procedures)
        for skill in skills
        if skill.function.calls is not None and procedures is not None
    ]
    code += [" ".join(package) for skill in skills if (package := brought_by(type(skill.function)))]
    beside = (module_beside(task.scene.environment, procedures) for task in tasks)
    code += [path.read_text(encoding="utf-8", errors="replace") for path in beside if path is not None]
    return _sha256(f"({full_repr(scope)}, {code!r})".encode())


def hashes(weights: Mapping[str, Weights]) -> dict[str, str]:
    return {skill: _sha256(np.ascontiguousarray(array, "<f4").tobytes()) for skill, array in sorted(weights.items())}


def versions() -> dict[str, str]:
    """The versions that a result may depend on."""
    installed = {package: installed_version(package) for package in ("mindlang", "mindrun", *COMPUTED_WITH)}
    return {"python": platform.python_version(), **{name: found for name, found in installed.items() if found}}


@cache
def own_build() -> Build:
    major, minor, _ = platform.python_version_tuple()
    packages = {package: installed_version(package) or "none" for package in COMPUTED_WITH}
    return {"mindrun": sources_hash(SOURCES), "python": f"{major}.{minor}", **packages}


def difference(asked: Build, own: Build) -> str:
    """The first difference of one's own build from the one that a job is for, in words; "" where there is none."""
    for name in sorted(own.keys() | asked.keys()):
        here, there = own.get(name), asked.get(name)
        if there != here:
            ours, theirs = (str(each)[:SHOWN_CHARACTERS] for each in (here, there))
            return f"{name} is {ours} at the worker, and {theirs} where the job comes from"
    return ""


def sources_hash(folder: Path) -> str:
    """The SHA-256 of the Python files below a folder, and of their names."""
    digest = sha256()
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def processor() -> str:
    """The processor's name, as well as the system knows it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or platform.machine())


def to_json(manifest: Manifest) -> bytes:
    said = {"format": MANIFEST_VERSION, **asdict(manifest), "lesson": encode(manifest.lesson)}
    return json.dumps(said, indent=2).encode() + b"\n"


def from_json(data: bytes) -> Manifest:
    """The manifest in these bytes; RunError where they are not one."""
    try:
        plain = parsed(data, len(data))
        if isinstance(plain, dict) and plain.get("format") != MANIFEST_VERSION:
            raise RunError("the run was made by another version of mindc", "resume it with that version")
        return _manifest(plain)
    except (ValueError, BundleError) as error:
        raise RunError("the run's manifest is damaged", "start the lesson again without --resume") from error


def _manifest(plain: Any) -> Manifest:
    """The manifest that this data is; ValueError or BundleError where it is none."""
    if not isinstance(plain, dict) or plain.keys() != {"format", *(field.name for field in fields(Manifest))}:
        raise ValueError("it has other parts")
    given = {name: value for name, value in plain.items() if name != "format"}
    for name, form in FORMS.items():
        value = plain[name]
        texts = [*value, *value.values()] if isinstance(value, dict) else value if form is list else [value]
        if not isinstance(value, form) or not all(isinstance(text, str) and "\0" not in text for text in texts):
            raise ValueError("it has parts of another form")
        given[name] = tuple(value) if form is list else value
    if not is_whole(plain["seed"], high=MAX_SEED):
        raise ValueError("it has another seed")
    given["lesson"] = lesson = decode_part(Lesson, plain["lesson"], "lesson")
    for found in lesson_flaws(lesson):
        raise ValueError(found)
    return Manifest(**given)


def _sha256(data: bytes) -> str:
    return sha256(data).hexdigest()
