"""What is said to a simulated world, and what it answers.

An exchange is a REQUEST with a name, then an ANSWER with what it holds. READ a sensor: its readings, float64. WRITE an
actuator: nothing, it has the value now. STATUS: JSON. WORLD: the row of a recording after the last tick
(`world_row_of`). BOXES: the obstacles [boxes, 4], float64. Where one is refused, the reason.
"""

from collections.abc import Iterator
from struct import Struct

READ, WRITE, STATUS, WORLD, BOXES = b"R", b"W", b"S", b"T", b"B"
REQUEST = Struct("<cHd")  # what, length of the name, value; then the name in UTF-8
ANSWER = Struct("<?Id")  # whether it was done, length of what it holds, when the tick began (monotonic seconds)


def requests(buffer: bytearray) -> Iterator[tuple[bytes, str, float]]:
    """The requests that are whole, taken out of the buffer; ValueError for what is none."""
    while len(buffer) >= REQUEST.size:
        what, length, value = REQUEST.unpack_from(buffer)
        end = REQUEST.size + length
        if what not in (READ, WRITE, STATUS, WORLD, BOXES):
            raise ValueError(f"{what!r} is no request")
        if len(buffer) < end:
            return
        name = buffer[REQUEST.size : end].decode()
        del buffer[:end]
        yield what, name, value
