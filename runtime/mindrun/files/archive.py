"""Zip files in memory, in the one form in which they are written here: nothing compressed, no name twice."""

import struct
import zipfile
from collections.abc import Iterable
from io import BytesIO

DIRECTORY_ENTRY = b"PK\x01\x02"  # how each entry of a zip's directory begins
MAX_ENTRIES = 20_000  # entries


def write_archive(members: Iterable[tuple[str, bytes]], comment: bytes = b"") -> bytes:
    """Files by name as the bytes of a zip; the same files in the same order are the same bytes."""
    file = BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
        for name, content in members:
            entry = zipfile.ZipInfo(name)  # of 1980: the day of writing is no part of a mind
            entry.create_system = 3
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
        archive.comment = comment
    return file.getvalue()


def read_archive(data: bytes) -> dict[str, bytes]:
    """The files in these bytes by name; ValueError where they are no zip, or one that was made by something else."""
    if data.count(DIRECTORY_ENTRY) > MAX_ENTRIES:
        raise ValueError("it has too many files")
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            entries = archive.infolist()
            if any(entry.compress_type != zipfile.ZIP_STORED for entry in entries):
                raise ValueError("it was packed by something else")
            if sum(entry.file_size for entry in entries) > len(data):
                raise ValueError("it claims to hold more than it does")
            members = {entry.filename: archive.read(entry) for entry in entries}
    except (zipfile.BadZipFile, RuntimeError, LookupError, TypeError, EOFError, OSError, struct.error) as error:
        raise ValueError("it is no whole zip") from error
    if len(members) < len(entries):
        raise ValueError("a file is in it twice")
    return members
