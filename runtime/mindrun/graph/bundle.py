"""A bundle: one file with everything a mind needs to run. A zip that any tool opens, but no byte of it may change.

It ends in the SHA-256 of all bytes before; the manifest has those of its members. Reading never runs a procedure.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from hashlib import sha256
from pathlib import Path
from typing import Any

from mindrun.errors import BundleError, WeightsError, system_errors_as
from mindrun.files.archive import read_archive, write_archive
from mindrun.files.atomic_write import write_out
from mindrun.files.npy import to_npy
from mindrun.files.regular_files import read_whole
from mindrun.files.strict_json import parsed
from mindrun.graph.codec import decode_part, encode
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.validate import graph_flaw
from mindrun.graph.weights import genes, read_weights
from mindrun.graph.wiring import Wiring, flaws
from mindrun.kinds.packages import missing
from mindrun.kinds.procedure_text import FILES, Sources
from mindrun.kinds.registry import brought_by, kinds, refused_packages
from mindrun.numbers.short_repr import ShortRepr

# A mindrun that knows nothing of wirings refuses a bundle that has one.
FORMAT, WIRED = "mind bundle 5", "mind bundle 6"
MANIFEST, GRAPH, WIRING = "manifest.json", "graph.json", "wiring.json"
WEIGHTS, MODULES = "weights/", "procedures/"
MAX_BUNDLE_BYTES = 64 << 20  # nothing is compressed, so this also limits what is read
MAX_JSON_BYTES = 4 << 20  # it takes up to twenty times as much memory, and half a second for each million
DIGEST_CHARACTERS = 64


@dataclass(frozen=True, slots=True, repr=False)
class Bundle(ShortRepr):
    """A policy, the texts of procedures with the files that they use, and a robot's wiring where there is a robot."""

    policy: Policy
    procedures: Sources
    wiring: Wiring | None = None

    @property
    def graph(self) -> Graph:
        """The hierarchy of its policy."""
        return self.policy.graph


def fingerprint(wiring: Wiring) -> str:
    """The SHA-256 by which a robot knows its wiring; it stands in the manifest, too."""
    return sha256(_json(encode(wiring))).hexdigest()


def write_bundle(path: Path, bundle: Bundle) -> str:
    """Write a mind to one file, which replaces an older one only when it is whole; the SHA-256 of its bytes.

    The same mind has the same bytes. OSError where it cannot be written.
    """
    data = pack(bundle)
    unpack(data)  # nothing is written that cannot be read
    write_out(path, data)
    return sha256(data).hexdigest()


def read_bundle(path: Path) -> Bundle:
    """Read a mind from a file; BundleError unless it is byte for byte what was written."""
    with system_errors_as(BundleError, f"cannot read {path}"):
        data = read_whole(path, MAX_BUNDLE_BYTES)
    try:
        return unpack(data)
    except BundleError as error:
        raise BundleError(f"{path}: {error}") from error


def digest(path: Path) -> str:
    """The SHA-256 of a bundle's file."""
    return sha256(read_whole(path, MAX_BUNDLE_BYTES)).hexdigest()


def pack(bundle: Bundle) -> bytes:
    members = _members(bundle)
    modules = [name for name, content in bundle.procedures.items() if isinstance(content, str)]
    manifest = _manifest(bundle.graph, bundle.policy.weights, modules, bundle.wiring, members)
    files = [(MANIFEST, _json(manifest)), *sorted(members.items())]
    data = write_archive(files, comment=bytes(DIGEST_CHARACTERS))[:-DIGEST_CHARACTERS]
    data += sha256(data).hexdigest().encode()
    if len(data) > MAX_BUNDLE_BYTES:
        raise BundleError(f"a bundle cannot be larger than {MAX_BUNDLE_BYTES >> 20} MiB")
    return data


def unpack(data: bytes) -> Bundle:
    """The bundle in these bytes; BundleError unless they are what `pack` gave."""
    if len(data) > MAX_BUNDLE_BYTES:
        raise BundleError(f"this is larger than a bundle can be ({MAX_BUNDLE_BYTES >> 20} MiB)")
    if not data.startswith(b"PK"):
        raise BundleError("this is not a bundle")
    if sha256(data[:-DIGEST_CHARACTERS]).hexdigest().encode() != data[-DIGEST_CHARACTERS:]:
        raise BundleError("this bundle is damaged: build or copy it again")
    try:
        return _bundle(read_archive(data))
    except (ValueError, WeightsError) as error:
        raise BundleError(f"this is not a bundle that this version can read: {error}") from error


def _members(bundle: Bundle) -> dict[str, bytes]:
    """The files of a bundle by name, without its manifest."""
    members = {GRAPH: _json(encode(bundle.graph))}
    members |= {f"{WEIGHTS}{skill}.npy": to_npy(weights) for skill, weights in bundle.policy.weights.items()}
    for name, content in bundle.procedures.items():
        if isinstance(content, str):
            members[f"{MODULES}{name.replace('.', '/')}.py"] = content.encode()
        else:
            members[name] = content
    return members | ({WIRING: _json(encode(bundle.wiring))} if bundle.wiring else {})


def _manifest(
    graph: Graph, skills: Iterable[str], modules: Iterable[str], wiring: Wiring | None, members: Mapping[str, bytes]
) -> dict[str, Any]:
    """The manifest of a bundle and its files: nothing that does not follow from them, and the packages of its kinds."""
    packages = dict(found for skill in graph.skills if (found := brought_by(type(skill.function))))
    return {
        "format": WIRED if wiring else FORMAT,
        "master": graph.master,
        "members": {name: sha256(content).hexdigest() for name, content in members.items()},
        "skills": sorted(skills),
        "procedures": sorted(modules),
        **({"wiring": fingerprint(wiring)} if wiring else {}),
        **({"packages": packages} if packages else {}),
    }


def _bundle(members: dict[str, bytes]) -> Bundle:
    """The bundle of these files; BundleError or ValueError where they are none."""
    manifest = parsed(members.pop(MANIFEST, b""))
    if not isinstance(manifest, dict) or manifest.get("format") not in (FORMAT, WIRED):
        raise BundleError(_foreign(manifest))
    _refuse_missing(manifest.get("packages", {}))
    graph = decode(migrated(_document(members, GRAPH)))
    weights = {name: read_weights(content) for name, content in _below(members, WEIGHTS, ".npy")}
    procedures = {name.replace("/", "."): content.decode() for name, content in _below(members, MODULES, ".py")}
    files = {f"{FILES}{name}": content for name, content in _below(members, FILES, "")}
    wiring = decode_wiring(_document(members, WIRING), graph) if manifest["format"] == WIRED else None
    known = 1 + len(weights) + len(procedures) + len(files) + (wiring is not None)
    if manifest != _manifest(graph, weights, procedures, wiring, members) or len(members) != known:
        raise BundleError("this bundle's files are not those of its manifest")
    _refuse_strangers(graph, weights, procedures)
    if not files.keys() <= {f"{FILES}{name}" for skill in graph.skills for name in skill.files}:
        raise BundleError("this bundle has files that no procedure of it uses")
    return Bundle(Policy(graph, weights), {**procedures, **files}, wiring)


def _refuse_missing(packages: object) -> None:
    """BundleError where a package of which a mind has kinds is not there, or another one is; or cannot be used."""
    if not isinstance(packages, dict) or not all(isinstance(digest, str) for digest in packages.values()):
        raise BundleError("this bundle's packages are no packages")
    for name, digest in packages.items():
        if lack := missing(name, digest):
            raise BundleError(lack)
        if why := refused_packages().get(name):
            raise BundleError(f"{name} cannot be imported: {why}")


def _refuse_strangers(graph: Graph, skills: Iterable[str], modules: Iterable[str]) -> None:
    """BundleError where there are weights of nobody, or a module of no name."""
    learning = {skill.name for skill in graph.skills if genes(skill) and not skill.like}
    for name in skills:
        if name not in learning:
            raise BundleError(f"this bundle has weights of {name!r:.60}, which is no skill of it that learns")
    for module in modules:
        if not all(part.isidentifier() for part in module.split(".")):
            raise BundleError(f"this bundle has a module {module!r:.60}, which is no name")


def _below(members: Mapping[str, bytes], folder: str, suffix: str) -> Iterator[tuple[str, bytes]]:
    """The files in a folder of a bundle, by their names without folder and suffix."""
    for name, content in members.items():
        if name.startswith(folder) and name.endswith(suffix):
            yield name[len(folder) : len(name) - len(suffix)], content


def _document(members: Mapping[str, bytes], name: str) -> Any:
    if name not in members:
        raise BundleError(f"this bundle has no {name}")
    return parsed(members[name], MAX_JSON_BYTES)


def _foreign(manifest: object) -> str:
    """Why a bundle with such a manifest cannot be read."""
    version = manifest.get("format") if isinstance(manifest, dict) else None
    if not isinstance(version, str) or not version.startswith("mind bundle"):
        return "this is not a bundle"
    return (
        f"this is a {version!r:.40}, this mindrun reads {FORMAT!r} and {WIRED!r}: "
        "build it again, or install the mindrun of the mindc that built it"
    )


def _json(value: Any) -> bytes:
    return json.dumps(value, ensure_ascii=False, sort_keys=True, separators=(",", ":")).encode()


def decode(data: object) -> Graph:
    """The graph that `encode` made this data of; BundleError where anything is missing, unknown or out of range."""
    graph = decode_part(Graph, data, "graph")
    found = graph_flaw(graph)
    if found:
        raise BundleError(f"this graph is damaged: {found}")
    return graph


def decode_wiring(data: object, graph: Graph) -> Wiring:
    """The wiring that `encode` made this data of; BundleError where it is damaged, or one for another mind."""
    wiring = decode_part(Wiring, data, "wiring")
    for found in flaws(wiring, graph):
        raise BundleError(f"this wiring does not fit its mind: {found}")
    return wiring


def migrated(graph: Any) -> Any:
    """The data of a graph of an older version as that of today: what its lessons had no word for has its default."""
    try:
        return graph | {"lessons": [_whole_lesson(lesson) for lesson in graph["lessons"]]}
    except (TypeError, LookupError):
        return graph


def _whole_lesson(lesson: Any) -> Any:
    """A lesson from before it had needs, and its learner all arguments.

    No lesson acts in a bundle, so a new argument makes no new format.
    """
    learner = lesson["learner"]
    usual = {field.name: field.default for field in fields(kinds("curriculum")[learner["is"]])}
    return {"needs": []} | lesson | {"learner": usual | learner}
