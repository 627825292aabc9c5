"""One of each artefact, whole; how its content is changed and sealed again; and how it is read and used then."""

import json
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import numpy as np
from mindrun.cli.report import report
from mindrun.engine.changes import ChangedEngine
from mindrun.files.archive import write_archive
from mindrun.files.npy import to_npy
from mindrun.graph.bundle import pack, unpack
from mindrun.graph.describe import contents, describe
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import CHECKSUM_FIELD, RecordedWorld, world_row_of
from mindrun.graph.weights import genes
from mindrun.robot.guardian import plan
from mindrun.robot.recording import About, Recorder
from mindrun.robot.replay import replay
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.train import checkpoint
from mindrun.train.manifest import hashes
from mindrun.train.progress import LINES, read_progress
from mindrun.train.run_folder import MANIFEST, RESULT, START, create, open_run, read_result
from mindrun.train.training import Watch, train

from mindlang.cli.deploy import _listed
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.lock import LockError, Taught, lock_path, read_lock
from mindlang.lock.blobs import load_weights, record
from mindlang.lock.report import rows
from mindlang.lock.world_facts import Worlds
from mindlang.pictures.learning_log import load_curves
from mindlang.robot.deployment import parse_state
from tests.engine.bundles import wired
from tests.engine.resealed import members_of, resealed
from tests.lock.test_worlds import MIND
from tests.resealed import tampering
from tests.robot.faults import graph as robot_graph
from tests.train.climbing import LENGTH, Sphere, forget, lesson, manifest, unwatched

BUNDLE = "ab" * 32


@dataclass(frozen=True, slots=True)
class Artefact:
    """`tamper` gives the files of a changed one by their paths, `use` does in a folder all that is done with it."""

    tamper: Callable[[Random], Mapping[str, bytes]]
    use: Callable[[Path], object]


# Bundles


NAMES = "/x", "../x", "weights/.npy", "a" * 999, "\x1b", "graph.json"


def tampered_bundle(rng: Random) -> dict[str, bytes]:
    """A bundle with the file of one of its parts changed, or a part of its manifest."""
    data = pack(wired())
    manifest: dict[str, Any] = {}

    def changed(members: dict[str, bytes]) -> None:
        name = rng.choice(["graph.json"] * 4 + ["wiring.json"] * 3 + ["name", "manifest.json", *members])
        if name == "name":
            old, new = rng.choice(sorted(members)), rng.choice(NAMES)
            members[new] = members.pop(old)
        elif name == "manifest.json":
            manifest.update(_object(tampering.document(members["manifest.json"], rng)))
        elif name.endswith(".npy"):
            members[name] = tampering.vector(members[name], rng)
        elif name.endswith(".json"):
            members[name] = tampering.document(members[name], rng)
        else:
            members[name] = rng.choice((b"", b"\xff", b"x = 1", b"\0", b"raise SystemExit(3)"))

    try:
        return {"x.bundle": resealed(data, changed, manifest)}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):  # a manifest that nobody could seal
        return tampered_bundle(rng)


def _object(data: bytes) -> dict[str, Any]:
    found = json.loads(data)
    return found if isinstance(found, dict) else {}


def use_bundle(folder: Path) -> object:
    """Read it, say what it holds, think with it, be its worlds for a while, and make the guardian's plan."""
    bundle = unpack((folder / "x.bundle").read_bytes())
    json.dumps(contents(bundle), allow_nan=False)
    assert all(line.isprintable() for line in describe(bundle).splitlines())
    engine = ChangedEngine(bundle.policy, bundle.procedures)
    for reading in (0.0, 0.5, 1.0, np.nan):
        commands = engine.tick(np.full(bundle.graph.width, reading))
        assert ((commands >= 0) & (commands <= 1)).all()
    for task in bundle.graph.tasks:
        world = CommandedWorld(bundle.graph, task.name, 1)
        for _ in range(5):
            world.step([1.0] * len(bundle.graph.actuators))
        assert np.isfinite(world.readings()).all()
    assert bundle.wiring
    neutrals = {actuator.name: actuator.kind.neutral for actuator in bundle.graph.actuators}
    made = plan.plan_of(bundle.graph.tick, neutrals, bundle.wiring)
    assert plan.from_json(plan.to_json(made)) == made
    assert unpack(pack(bundle)) is not None
    return bundle


# The guardian's plan


def tampered_plan(rng: Random) -> dict[str, bytes]:
    """A plan of a robot."""
    bundle = wired()
    assert bundle.wiring
    neutrals = {actuator.name: actuator.kind.neutral for actuator in bundle.graph.actuators}
    text = plan.to_json(plan.plan_of(bundle.graph.tick, neutrals, bundle.wiring))
    return {"plan": tampering.document(text.encode(), rng)}


def use_plan(folder: Path) -> object:
    """Read it as the guardian does."""
    return plan.read_plan(folder / "plan")


# Recordings


@cache
def recorded() -> tuple[Graph, About, bytes]:
    """A short recording in a world, what it is of, and its graph."""
    graph = robot_graph("range_finder")
    [task] = graph.tasks
    row = world_row_of(task)["things"]
    world = RecordedWorld.of(task, 7, np.ones((2, 4)), [1.0] * (3 + row.shape[0] * row.shape[1]))
    about = replace(About.of(graph, BUNDLE, graph.master, ("sense",)), world=world)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "day.rec"
        with Recorder(path, about) as recorder:
            engine = ChangedEngine(Policy(graph, {}))
            for tick in range(5):
                readings = np.full(graph.width, tick / 5, np.float32)
                commands = engine.tick(readings)
                recorder.write(
                    tick=tick,
                    time=tick * graph.tick,
                    readings=engine.readings,
                    commands=commands,
                    influence=engine.influence,
                )
        return graph, about, path.read_bytes()


def tampered_recording(rng: Random) -> dict[str, bytes]:
    """A recording with its first line changed, or rows of any bytes; the checksums are right."""
    _, about, data = recorded()
    line, _, rest = data.partition(b"\n")
    if rng.random() < 0.3:
        row = about.row
        noise = np.frombuffer(
            rng.choice((rng.randbytes(row.itemsize), b"\xff" * row.itemsize, bytes(row.itemsize))), row
        ).copy()
        noise["check"] = 0
        noise["check"] = zlib.crc32(noise.tobytes())
        rest = rest[: rng.choice((0, 1, 2, 5)) * row.itemsize] + noise.tobytes() * rng.choice((1, 2))
    else:
        said = json.loads(line)
        del said["check"]
        changed = tampering.document(json.dumps(said).encode(), rng)
        line = changed[:-1] + CHECKSUM_FIELD + f"{zlib.crc32(changed[:-1]):08x}".encode() + b'"}'
        line = rng.choice((line, line, changed))
    return {"x.rec": line + b"\n" + rest}


def use_recording(folder: Path) -> object:
    """Compute it again, and hold it against its source."""
    graph, path = recorded()[0], folder / "x.rec"
    return replay(path, BUNDLE, ChangedEngine(Policy(graph, {}))), report(path, BUNDLE, graph)


# Locks and the weights that they name


@cache
def taught_project() -> tuple[Graph, Mapping[str, bytes]]:
    """A mind of which one skill has been taught, and the files beside it."""
    graph = compile_source(Source(Path("x.mind"), MIND)).graph
    assert graph is not None
    with TemporaryDirectory() as name:
        folder = Path(name)
        skill = next(each for each in graph.skills if genes(each))
        weights = np.linspace(-1, 1, genes(skill), dtype=np.float32)
        world = Worlds(graph, folder).of(graph.lessons[0])
        record(folder / "x.lock", graph, {skill.name: weights}, Taught("Top", "Top", False, 3, 8, 1, 1.5), {}, world)
        return graph, {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def tampered_lock(rng: Random) -> dict[str, bytes]:
    """A lock with other words; the worlds in it have the names that their lines give them."""
    files = dict(taught_project()[1])
    text = tampering.lines(files["x.lock"], rng)
    head, mark, block = text.partition(b"\nworld ")
    if mark and rng.random() < 0.7:
        old, _, facts = block.partition(b"\n")
        new = sha256(facts.rstrip(b"\n")).hexdigest()[:16].encode()
        text = (head + mark + new + b"\n" + facts).replace(old, new) if old else text
    return files | {"x.lock": text}


def tampered_weights(rng: Random) -> dict[str, bytes]:
    """Weights changed, and named by their new hash in the lock."""
    files = dict(taught_project()[1])
    name = next(each for each in files if each.endswith(".npy"))
    old, data = Path(name).stem, tampering.vector(files.pop(name), rng)
    new = sha256(data).hexdigest()
    return files | {f"weights/{new}.npy": data, "x.lock": files["x.lock"].replace(old.encode(), new.encode())}


def use_lock(folder: Path) -> object:
    """Read it, say how its skills stand, and load what they have learnt."""
    graph = taught_project()[0]
    lock = read_lock(lock_path(folder / "x.mind"))
    found = rows(graph, [folder / "x.mind"])
    for entry in lock.values():
        skill = next((each for each in graph.skills if each.name == entry.skill), None)
        if skill is None:
            raise LockError(f"{entry.skill} is no skill")
        load_weights(entry, skill)
    return found


# Runs


@cache
def run_files() -> Mapping[str, bytes]:
    """The files of a run that was stopped."""
    weights = {"Climb": np.arange(LENGTH, dtype=np.float32), "Go+Avoid": np.ones(3, np.float32)}
    with TemporaryDirectory() as folder:
        run = create(Path(folder), manifest(lesson(4, population=6, attempts=2), weights=weights), {}, weights)
        train(run, Sphere(), unwatched(stop_after=3))
        (run.folder / RESULT).write_text('{"lesson": "Climb", "best": 1.5, "verdicts": [1.0, null]}\n')
        return {path.name: path.read_bytes() for path in run.folder.iterdir() if path.is_file()}


def tampered_manifest(rng: Random) -> dict[str, bytes]:
    """A run with another manifest."""
    return {**run_files(), MANIFEST: tampering.document(run_files()[MANIFEST], rng)}


def tampered_start(rng: Random) -> dict[str, bytes]:
    """A run that began with other weights, whose hashes its manifest has."""

    def changed(members: dict[str, bytes]) -> None:
        name = rng.choice(sorted(members))
        match rng.randrange(4):
            case 0:
                members[rng.choice(("", "x", "../x.npy", "Climb.npy", "Top.npy", "\x1b.npy"))] = members.pop(name)
            case 1:
                members[name] = to_npy(np.ones(rng.choice((0, 1, LENGTH + 1, 100_000)), np.float32))
            case _:
                members[name] = tampering.vector(members[name], rng)

    members = members_of(run_files()[START])
    changed(members)
    said = json.loads(run_files()[MANIFEST])
    said["weights"] = {name.removesuffix(".npy"): _hash(data) for name, data in members.items()}
    return {**run_files(), START: write_archive(members.items()), MANIFEST: json.dumps(said).encode()}


def _hash(data: bytes) -> str:
    """What the manifest says of weights: the hash of the numbers, where these are some."""
    start = 10 + int.from_bytes(data[8:10], "little")
    values = data[start:][: (len(data) - start) // 4 * 4]
    return hashes({"": np.frombuffer(values, "<f4")})[""]


def tampered_checkpoint(rng: Random) -> dict[str, bytes]:
    """A run that stands elsewhere."""
    body = run_files()[checkpoint.NAME][len(checkpoint.MAGIC) : -checkpoint.DIGEST_BYTES]
    header, _, rest = body.partition(b"\n")
    match rng.randrange(4):
        case 0:
            numbers = np.frombuffer(rest[-56:], "<i8").copy()
            numbers[rng.randrange(7)] = rng.choice((-1, 0, 1, 2, 5, 2**31, 2**53 + 2, 2**62))
            rest = rest[:-56] + numbers.tobytes()
        case 1:
            place = rng.randrange(max(1, len(rest) - 8))
            rest = (
                rest[:place]
                + rng.choice((b"\xff" * 8, bytes(8), rng.randbytes(8), b"\0\0\xc0\x7f" * 2))
                + rest[place + 8 :]
            )
        case 2:
            rest = rng.choice((b"", rest[:-1], rest + bytes(8), rest * 2))
        case _:
            header = tampering.document(header, rng).replace(b"\n", b" ")
    body = checkpoint.MAGIC + header + b"\n" + rest
    sealed = body + sha256(body).digest()
    return {**run_files(), checkpoint.NAME: sealed, checkpoint.PREVIOUS: rng.choice((sealed, b""))}


def tampered_log(rng: Random) -> dict[str, bytes]:
    """A run with other lines in its log, or another result."""
    if rng.random() < 0.2:
        return {**run_files(), RESULT: tampering.document(run_files()[RESULT], rng)}
    found = run_files()[LINES].splitlines()
    number = rng.randrange(len(found))
    found[number] = tampering.document(found[number], rng).replace(b"\n", b" ")
    return {**run_files(), LINES: b"\n".join([*found, b""])}


def use_run(folder: Path) -> object:
    """Open it, look at its log and its result, and go on with it for a while."""
    json.dumps(read_result(folder), allow_nan=False)
    run = open_run(folder)
    read_progress(folder)
    for curve in load_curves([folder]):
        for attempt in curve.attempts:
            assert np.isfinite(np.array(curve.points(attempt, "best"), float)).all()
    learner = run.manifest.lesson.learner
    if learner.population * learner.layouts > 10_000:
        return run.course(LENGTH)  # which would only take long
    left = iter(range(6))
    return train(run, Sphere(), Watch(forget, forget, lambda: next(left, None) is None, perf_counter, save_every=0.0))


# Releases on a robot


def tampered_release(rng: Random) -> dict[str, bytes]:
    """What a robot says of a release."""
    made_of = {"bundle": "ball.bundle", "sha256": "0" * 64, "master": "Roam"}
    return {"release.json": tampering.document(json.dumps(made_of).encode(), rng)}


def use_release(folder: Path) -> object:
    """List it."""
    said = (folder / "release.json").read_bytes().decode(errors="replace")
    return json.dumps(_listed(parse_state([("current", ""), ("release", f"20261121T193404Z-8c7cb8b2 whole {said}")])))


ARTEFACTS = {
    "bundle": Artefact(tampered_bundle, use_bundle),
    "plan": Artefact(tampered_plan, use_plan),
    "recording": Artefact(tampered_recording, use_recording),
    "lock": Artefact(tampered_lock, use_lock),
    "weights": Artefact(tampered_weights, use_lock),
    "manifest": Artefact(tampered_manifest, use_run),
    "start": Artefact(tampered_start, use_run),
    "checkpoint": Artefact(tampered_checkpoint, use_run),
    "log": Artefact(tampered_log, use_run),
    "release": Artefact(tampered_release, use_release),
}
