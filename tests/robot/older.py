"""Recordings as older versions wrote them."""

import zlib
from pathlib import Path

from mindrun.graph.recording_header import CHECKSUM_FIELD


def older(path: Path) -> None:
    """Let a recording without a world say that it is of the second version: its rows are the same."""
    line, _, rows = path.read_bytes().partition(b"\n")
    said = line.rpartition(CHECKSUM_FIELD)[0].replace(b"mind recording 3", b"mind recording 2")
    path.write_bytes(said + CHECKSUM_FIELD + f"{zlib.crc32(said):08x}".encode() + b'"}\n' + rows)
