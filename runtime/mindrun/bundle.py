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

from mindrun.durable import write_out
from mindrun.encoding import decode, decode_wiring, encode
from mindrun.errors import BundleError, WeightsError
from mindrun.graph import Graph
from mindrun.regular import read_regular
from mindrun.robot.wiring import Wiring
from mindrun.weights import Weights, from_npy, to_npy, weights_of

# A mindrun that knows nothing of wirings refuses a bundle that has one.
FORMAT, WIRED = "mind bundle 1", "mind bundle 2"
WIRING = "wiring.json"
LARGEST = 64 << 20  # bytes; nothing is compressed, so this also limits what is read
DIGEST = 64


@dataclass(frozen=True, slots=True)
class Bundle:
    """What is in a bundle: `procedures` has the text of each module by dotted name; not every mind has a robot."""

    graph: Graph
    weights: dict[str, Weights]
    procedures: dict[str, str]
    wiring: Wiring | None = None


def fingerprint(wiring: Wiring) -> str:
    """The SHA-256 by which a robot knows its wiring; it stands in the manifest, too."""
    return sha256(_json(encode(wiring))).hexdigest()


def write_bundle(
    path: Path,
    graph: Graph,
    weights: Mapping[str, Weights],
    procedures: Mapping[str, str],
    wiring: Wiring | None = None,
) -> str:
    """Write a mind to one file, which replaces an older one only when it is whole; the SHA-256 of its bytes.

    The same mind has the same bytes.
    """
    data = pack(Bundle(graph, dict(weights), dict(procedures), wiring))
    unpack(data)  # nothing is written that cannot be read
    write_out(path, data)
    return sha256(data).hexdigest()


def read_bundle(path: Path) -> Bundle:
    """Read a mind from a file; BundleError unless it is byte for byte what was written."""
    try:
        data = read_regular(path, LARGEST + 1)
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
    if bundle.wiring:
        members[WIRING] = _json(encode(bundle.wiring))
    manifest = {
        "format": WIRED if bundle.wiring else FORMAT,
        "master": bundle.graph.master,
        "members": {name: sha256(content).hexdigest() for name, content in members.items()},
        "skills": sorted(bundle.weights),
        "procedures": sorted(bundle.procedures),
    } | ({"wiring": fingerprint(bundle.wiring)} if bundle.wiring else {})
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
    if manifest["format"] not in (FORMAT, WIRED):
        raise BundleError(
            f"this is a {manifest['format']!r}, this mindrun reads {FORMAT!r} and {WIRED!r}: "
            "build it again, or install the mindrun of the mindc that built it"
        )
    if manifest["members"] != {name: sha256(content).hexdigest() for name, content in members.items()}:
        raise BundleError("this bundle's files are not those of its manifest")
    graph = decode(_parsed(members["graph.json"]))
    weights = {skill: from_npy(members[f"weights/{skill}.npy"]) for skill in manifest["skills"]}
    for skill in graph.skills:
        if skill.name in weights:
            weights_of(skill, weights)
    procedures = {module: members[_module_member(module)].decode() for module in manifest["procedures"]}
    return Bundle(graph, weights, procedures, _wiring(manifest, members, graph))


def _wiring(manifest: Any, members: dict[str, bytes], graph: Graph) -> Wiring | None:
    """What is wired to what, where the bundle is for a robot."""
    if manifest["format"] == FORMAT:
        return None
    wiring = decode_wiring(_parsed(members[WIRING]), graph)
    if manifest["wiring"] != fingerprint(wiring):
        raise BundleError("this bundle's wiring is not that of its manifest")
    return wiring


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
