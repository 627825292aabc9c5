"""Bundles that are not what `pack` gives, with every hash made right again."""

import json
import zipfile
from collections.abc import Callable, Mapping
from hashlib import sha256
from io import BytesIO
from typing import Any

MANIFEST = "manifest.json"
Change = Callable[[dict[str, bytes]], None]


def members_of(data: bytes) -> dict[str, bytes]:
    """The files of a bundle by name."""
    with zipfile.ZipFile(BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def resealed(data: bytes, change: Change, manifest: Mapping[str, Any] | None = None) -> bytes:
    """A bundle with its files changed; its manifest says so, and what else it is told to say."""
    members = members_of(data)
    change(members)
    said = json.loads(members.pop(MANIFEST))
    said["members"] = {name: sha256(content).hexdigest() for name, content in members.items()}
    return sealed({MANIFEST: json.dumps(said | (manifest or {})).encode(), **members})


def sealed(members: Mapping[str, bytes], compression: int = zipfile.ZIP_STORED) -> bytes:
    """These files as a bundle, with its hash."""
    file = BytesIO()
    with zipfile.ZipFile(file, "w", compression) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
        archive.comment = bytes(64)
    body = file.getvalue()[:-64]
    return body + sha256(body).hexdigest().encode()
