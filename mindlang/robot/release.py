"""A release: a folder with the bundle, the mindrun that reads it and its services; its name stands for every byte."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import mindrun
from mindrun.files.regular_files import read_whole
from mindrun.graph.bundle import MAX_BUNDLE_BYTES, Bundle
from mindrun.graph.wiring import code_digests

from mindlang.robot.unit import ARMED, SERVICE, unit

WORKSTATION = "sim"  # the room of mindrun that no robot has a use for


@dataclass(frozen=True, slots=True)
class Release:
    """A release that lies in a folder here: `fingerprint` is the SHA-256 of its SHA256SUMS."""

    folder: Path
    fingerprint: str
    size: int

    def named(self, moment: str) -> str:
        """What it is called on the robot: names sort by their age."""
        return f"{moment}-{self.fingerprint[:8]}"


def make_release(path: Path, bundle: Bundle, folder: Path) -> Release:
    """Lay a release out in an empty folder. The same bundle and the same mindrun have the same fingerprint."""
    data = read_whole(path, MAX_BUNDLE_BYTES)
    made_of: dict[str, object] = {"bundle": path.name, "sha256": sha256(data).hexdigest()}
    made_of |= {"master": bundle.graph.master}
    if bundle.wiring and (digests := code_digests(bundle.wiring)):
        made_of |= {"drivers": digests}
    files = {
        "mind.bundle": data,  # never by its own name: no text of a user becomes a path on the robot
        "release.json": json.dumps(made_of).encode(),  # in ASCII, on one line
        SERVICE: unit().encode(),
        ARMED: unit(arm=True).encode(),
        **dict(_runtime()),
    }
    sums = "".join(f"{sha256(content).hexdigest()}  {name}\n" for name, content in sorted(files.items())).encode()
    for name, content in {**files, "SHA256SUMS": sums}.items():
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
    return Release(folder, sha256(sums).hexdigest(), sum(map(len, files.values())))


def _runtime() -> Iterator[tuple[str, bytes]]:
    """The files of the mindrun that runs here, so that the robot has the very one that knows this bundle."""
    root = Path(mindrun.__path__[0])
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if path.is_file() and parts[0] != WORKSTATION and "__pycache__" not in parts:
            yield "/".join(("runtime", "mindrun", *parts)), path.read_bytes()
