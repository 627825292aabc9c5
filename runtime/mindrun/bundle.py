"""A bundle: one file with everything a mind needs to run. A zip that any tool opens, but no byte of it may change.

It ends in the SHA-256 of all bytes before; the manifest has those of its members. Reading never runs a procedure.
"""

import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any, NoReturn

from mindrun.durable import write
from mindrun.encoding import decode, encode
from mindrun.errors import BundleError, WeightsError
from mindrun.graph import Graph
from mindrun.weights import Weights, from_npy, to_npy, weights_of

FORMAT = "mind bundle 1"
LARGEST = 64 << 20  # bytes; nothing is compressed, so this also limits what is read
DIGEST = 64


@dataclass(frozen=True, slots=True)
class Bundle:
    """What is in a bundle: `procedures` has the text of each module by dotted name."""

    graph: Graph
    weights: dict[str, Weights]
    procedures: dict[str, str]


def write_bundle(path: Path, graph: Graph, weights: Mapping[str, Weights], procedures: Mapping[str, str]) -> None:
    """Write a mind to one file, which replaces an older one only when it is whole; the same mind, the same bytes."""
    data = pack(Bundle(graph, dict(weights), dict(procedures)))
    unpack(data)  # nothing is written that cannot be read
    write(path, data)


def read_bundle(path: Path) -> Bundle:
    """Read a mind from a file; BundleError unless it is byte for byte what was written."""
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise BundleError(f"cannot read {path}: {error.strerror}") from error
    try:
        return unpack(data)
    except BundleError as error:
        raise BundleError(f"{path}: {error}") from error


def pack(bundle: Bundle) -> bytes:
    """A bundle as bytes."""
    members = {"graph.json": _json(encode(bundle.graph))}
    members |= {f"weights/{skill}.npy": to_npy(weights) for skill, weights in bundle.weights.items()}
    members |= {_module_member(module): text.encode() for module, text in bundle.procedures.items()}
    manifest = {
        "format": FORMAT,
        "master": bundle.graph.master,
        "members": {name: sha256(content).hexdigest() for name, content in members.items()},
        "skills": sorted(bundle.weights),
        "procedures": sorted(bundle.procedures),
    }
    file = BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
        for name, content in [("manifest.json", _json(manifest)), *sorted(members.items())]:
            archive.writestr(_entry(name), content)
        archive.comment = bytes(DIGEST)
    data = file.getvalue()[:-DIGEST]
    data += sha256(data).hexdigest().encode()
    if len(data) > LARGEST:
        raise BundleError(f"a bundle cannot be larger than {LARGEST >> 20} MiB")
    return data


def unpack(data: bytes) -> Bundle:
    """The bundle in these bytes; BundleError unless they are what `pack` gave."""
    if len(data) > LARGEST:
        raise BundleError(f"this is larger than a bundle can be ({LARGEST >> 20} MiB)")
    if not data.startswith(b"PK"):
        raise BundleError("this is not a bundle")
    if sha256(data[:-DIGEST]).hexdigest().encode() != data[-DIGEST:]:
        raise BundleError("this bundle is damaged: build or copy it again")
    try:
        return _bundle(_members(data))
    except (zipfile.BadZipFile, WeightsError, ValueError, LookupError, TypeError, RuntimeError, EOFError) as error:
        raise BundleError(f"this is not a bundle that this version can read ({error})") from error


def _members(data: bytes) -> dict[str, bytes]:
    """The zip's files; those that are compressed are refused unread."""
    with zipfile.ZipFile(BytesIO(data)) as archive:
        entries = archive.infolist()
        if any(entry.compress_type != zipfile.ZIP_STORED for entry in entries):
            raise BundleError("this bundle was packed by something else: build it again")
        if sum(entry.file_size for entry in entries) > len(data):
            raise BundleError("this bundle claims to hold more than it does")
        return {entry.filename: archive.read(entry) for entry in entries}


def _bundle(members: dict[str, bytes]) -> Bundle:
    manifest = _parsed(members.pop("manifest.json"))
    if manifest["format"] != FORMAT:
        raise BundleError(f"this is a {manifest['format']!r}, this mindrun reads a {FORMAT!r}: build it again")
    if manifest["members"] != {name: sha256(content).hexdigest() for name, content in members.items()}:
        raise BundleError("this bundle's files are not those of its manifest")
    graph = decode(_parsed(members["graph.json"]))
    weights = {skill: from_npy(members[f"weights/{skill}.npy"]) for skill in manifest["skills"]}
    for skill in graph.skills:
        if skill.name in weights:
            weights_of(skill, weights)
    procedures = {module: members[_module_member(module)].decode() for module in manifest["procedures"]}
    return Bundle(graph, weights, procedures)


def _entry(name: str) -> zipfile.ZipInfo:
    entry = zipfile.ZipInfo(name)  # of 1980: the day of writing is no part of a mind
    entry.create_system = 3
    entry.external_attr = 0o644 << 16
    return entry


def _module_member(module: str) -> str:
    return f"procedures/{module.replace('.', '/')}.py"


def _json(value: Any) -> bytes:
    return json.dumps(value, ensure_ascii=False, allow_nan=False, sort_keys=True, separators=(",", ":")).encode()


def _parsed(data: bytes) -> Any:
    return json.loads(data, parse_constant=_no_number)


def _no_number(text: str) -> NoReturn:
    raise BundleError(f"{text} is not a number that a bundle can hold")
