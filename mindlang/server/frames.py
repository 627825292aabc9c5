"""What an editor sends, cut into messages: whatever arrives, what can be read of it is, and the rest is refused."""

import json
import re
from collections.abc import Iterator
from typing import BinaryIO

MAX_MESSAGE_BYTES = 64 << 20
MAX_HEADER_BYTES, MAX_HEADER_LINES = 1 << 16, 100  # bytes of a header, and how many there may be
SKIPPED_BYTES = 1 << 20  # passed over at once

_LENGTH = re.compile(rb"content-length:[ \t]*([-+]?[0-9]{1,18})[ \t]*\r?\n?\Z", re.IGNORECASE)
HEADLESS = "A message begins with Content-Length: and the number of its bytes, which is above 0."
TOO_LARGE = f"A message has at most {MAX_MESSAGE_BYTES >> 20} MiB."
REFUSALS = (HEADLESS, TOO_LARGE)


class Frames:
    """A stream as pygls reads it: `readline` the length of a message and a blank line, `read` the message.

    What is no message comes as a JSON string that says why, which the protocol answers with an error.
    """

    def __init__(self, stream: BinaryIO) -> None:
        self._bodies = bodies(stream)
        self._lines: list[bytes] = []
        self._body = b""

    def readline(self) -> bytes:
        """The next line of a header; nothing at the end of the stream."""
        if not self._lines:
            self._body = next(self._bodies, b"")
            if not self._body:
                return b""
            self._lines = [b"\r\n", b"Content-Length: %d\r\n" % len(self._body)]
        return self._lines.pop()

    def read(self, size: int) -> bytes:
        """The message."""
        return self._body


def bodies(stream: BinaryIO) -> Iterator[bytes]:
    """The messages of a stream, and a refusal for each that is none."""
    while (length := _length(stream)) is not None:
        if not 0 < length <= MAX_MESSAGE_BYTES:
            _pass(stream, length)
            yield json.dumps(TOO_LARGE if length > MAX_MESSAGE_BYTES else HEADLESS).encode()
        elif len(body := stream.read(length)) == length:
            yield body


def _length(stream: BinaryIO) -> int | None:
    """The length that a header says, 0 where it says none; None at the end of the stream."""
    length, number = 0, 0
    while line := stream.readline(MAX_HEADER_BYTES):
        number += 1
        if found := _LENGTH.search(line):
            length = int(found[1])
        if (not line.strip() and number > 1) or number == MAX_HEADER_LINES:
            return length
        if not line.strip():  # blank lines between messages
            number = 0
    return None


def _pass(stream: BinaryIO, length: int) -> None:
    """Pass over a message."""
    while length > 0 and (part := stream.read(min(length, SKIPPED_BYTES))):
        length -= len(part)
