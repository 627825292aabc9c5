"""Bundles in which every hash is right, and what they hold is not what a mind has: refused, each in one sentence."""

import json
import zipfile
from collections.abc import Callable
from hashlib import sha256
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from mindrun.errors import BundleError
from mindrun.files.archive import read_archive
from mindrun.files.npy import to_npy
from mindrun.graph.bundle import pack, unpack

from tests.engine.bundles import example, wired
from tests.engine.resealed import Change, members_of, resealed, sealed

Tree = Any


def nothing(members: dict[str, bytes]) -> None:
    """No change."""


def without(name: str) -> Change:
    """A file taken away."""
    return lambda members: members.pop(name) and None


def with_file(name: str, content: bytes) -> Change:
    """A file added, or replaced."""
    return lambda members: members.update({name: content})


def with_weights(skill: str) -> Change:
    """The weights of the skill that learns, for another one, too."""
    return lambda members: members.update({f"weights/{skill}.npy": members["weights/Go+On.npy"]})


def graph(change: Callable[[Tree], object]) -> Change:
    """A change of what the graph says."""

    def changed(members: dict[str, bytes]) -> None:
        tree = json.loads(members["graph.json"])
        change(tree)
        members["graph.json"] = json.dumps(tree).encode()

    return changed


def actuator(**changes: object) -> Change:
    """A change of the second actuator."""
    return graph(lambda tree: tree["actuators"][1].update(changes))


FILES = {
    "a file more": (with_file("more.txt", b"more"), "not those of its manifest"),
    "weights elsewhere": (with_file("Go+On.npy", to_npy(np.ones(6, np.float32))), "not those of its manifest"),
    "what is not weights among them": (with_file("weights/Go+On.txt", b""), "not those of its manifest"),
    "what is no module among them": (with_file("procedures/parts/claw.txt", b""), "not those of its manifest"),
    "a module elsewhere": (with_file("parts/claw.py", b""), "not those of its manifest"),
    "no graph": (without("graph.json"), "has no graph.json"),
    "no wiring": (without("wiring.json"), "has no wiring.json"),
    "weights of nobody": (with_weights("Nobody"), "no skill of it that learns"),
    "weights of a rule": (with_weights("Top"), "no skill of it that learns"),
    "too few weights": (with_file("weights/Go+On.npy", to_npy(np.ones(3, np.float32))), "needs 6 float32 weights"),
    "a module called ..": (with_file("procedures/../a.py", b""), "which is no name"),
    "a module that is no text": (with_file("procedures/parts/claw.py", b"\xff"), "this version can read"),
    "a deep graph": (with_file("graph.json", b"[" * 100_000), "nested too deep"),
    "a large graph": (with_file("graph.json", b" " * (5 << 20)), "larger than 4 MiB"),
    "a number of many digits": (with_file("graph.json", b"9" * 5000), "this version can read"),
    "a field more": (graph(lambda tree: tree.update(more=1)), "graph is not a Graph"),
    "a field of a kind more": (graph(lambda tree: tree["actuators"][0]["kind"].update(more=1)), "is not a Wheel"),
    "a number of no world": (graph(lambda tree: tree["body"].update(size=10**300)), "is no number that can be"),
    "an infinite number": (graph(lambda tree: tree["body"].update(size=float("inf"))), "is no number"),
    "a tick of no time": (graph(lambda tree: tree.update(tick=1e-300)), "its tick cannot be"),
    "readings that overlap": (graph(lambda tree: tree["sensors"][0].update(start=1)), "not the readings of its kind"),
    "a name that a terminal obeys": (actuator(name="\x1b[2J"), "name cannot be"),
    "a name of two words": (actuator(name="left wheel"), "called 'left wheel'"),
    "a name twice": (actuator(name="left_wheel"), "called 'left_wheel' twice"),
}
MANIFESTS: dict[str, dict[str, Any]] = {
    "more": {"more": 1},
    "another master": {"master": "Grip"},
    "modules of no name": {"procedures": [[]]},
    "skills that are a number": {"skills": 7},
    "another wiring": {"wiring": "0" * 64},
}


def manifest_listing(what: str) -> dict[str, Any]:
    """What the manifest has to say of weights or modules that a change adds."""
    added = {"weights of nobody": "Nobody", "weights of a rule": "Top"}.get(what)
    listed: dict[str, Any] = {"skills": sorted(["Go+On", added])} if added else {}
    return listed | ({"procedures": ["...a", "parts.claw"]} if what == "a module called .." else {})


@pytest.mark.parametrize("what", FILES)
def test_every_hash_is_right_and_what_they_are_of_is_not(what: str) -> None:
    change, why = FILES[what]
    with pytest.raises(BundleError, match=why):
        unpack(resealed(pack(wired()), change, manifest_listing(what)))


@pytest.mark.parametrize("what", MANIFESTS)
def test_a_manifest_says_what_follows_from_the_files(what: str) -> None:
    with pytest.raises(BundleError, match="not those of its manifest"):
        unpack(resealed(pack(wired()), nothing, MANIFESTS[what]))


@pytest.mark.parametrize("manifest", [b"", b"[]", b"{", b'{"format": []}', b'{"format": "mind"}'])
def test_a_manifest_that_is_none(manifest: bytes) -> None:
    with pytest.raises(BundleError, match="this is not a bundle"):
        unpack(sealed(members_of(pack(wired())) | {"manifest.json": manifest}))


def test_what_is_packed_in_another_way_is_refused() -> None:
    members = members_of(pack(example()))
    with pytest.raises(BundleError, match="packed by something else"):
        unpack(sealed(members, zipfile.ZIP_DEFLATED))
    with pytest.raises(BundleError, match="too many files"):
        unpack(sealed(members | {f"more/{number}": b"" for number in range(20_001)}))
    with pytest.raises(BundleError, match="no whole zip"):
        unpack(b"PK" + bytes(30) + sha256(b"PK" + bytes(30)).hexdigest().encode())


def test_a_zip_that_claims_more_than_there_is_refused() -> None:
    claims = bytearray(pack(example())[:-64])
    size = claims.index(b"PK\x01\x02") + 24
    claims[size : size + 4] = (1 << 30).to_bytes(4, "little")
    with pytest.raises(BundleError, match="claims to hold more"):
        unpack(bytes(claims) + sha256(claims).hexdigest().encode())


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_file_that_is_there_twice_is_refused() -> None:
    file = BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("a", b"")
        archive.writestr("a", b"")
    with pytest.raises(ValueError, match="twice"):
        read_archive(file.getvalue())
