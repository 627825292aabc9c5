"""Only what is exactly a frame is one."""

import struct
from math import inf, nan
from zlib import crc32

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.robot.guardian.messages import CHECK, HEAD, MAX_COMMANDS, FrameError, Reader, pack, size

SHARES = st.floats(0, 1, width=32)


@given(st.lists(SHARES, min_size=1, max_size=9), st.booleans(), st.integers(0, 2**64 - 1), st.integers(0, 2**62))
def test_a_frame_is_read_as_it_was_written(commands: list[float], armed: bool, number: int, sent: int) -> None:
    frame = Reader(len(commands)).feed(pack(number, sent, armed, commands))[0]
    assert (frame.commands, frame.armed, frame.number, frame.sent) == (tuple(commands), armed, number, sent / 1e9)


@given(st.lists(st.integers(1, 60), max_size=20))
def test_it_does_not_matter_in_which_pieces_frames_come(pieces: list[int]) -> None:
    reader, data, frames = Reader(2), b"".join(pack(number, 0, True, (0, 1)) for number in range(5)), []
    for piece in pieces:
        frames += reader.feed(data[:piece])
        data = data[piece:]
    assert [frame.number for frame in frames + reader.feed(data)] == [0, 1, 2, 3, 4]


@given(st.binary(min_size=size(2)))
def test_any_other_bytes_are_refused(data: bytes) -> None:
    with pytest.raises(FrameError):
        Reader(2).feed(data)


@given(st.integers(0, 8 * size(2) - 1))
def test_one_wrong_bit_is_noticed(bit: int) -> None:
    data = bytearray(pack(7, 1, True, (0.5, 0.5)))
    data[bit // 8] ^= 1 << bit % 8
    with pytest.raises(FrameError):
        Reader(2).feed(bytes(data))


@pytest.mark.parametrize("value", [nan, inf, -inf, -0.001, 1.001, 1e300, -1e300])
def test_a_command_that_is_no_share_is_refused(value: float) -> None:
    with pytest.raises(FrameError, match="command"):
        Reader(2).feed(pack(1, 0, True, (0.5, value)))


def sealed(magic: bytes = b"MIND", version: int = 2, armed: int = 1, count: int = 1, number: int = 0) -> bytes:
    """A frame of one command whose check is right, whatever else it says."""
    data = struct.pack(f"{HEAD}f", magic, version, armed, count, number, 0, 0.5)
    return data + CHECK.pack(crc32(data))


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (sealed(magic=b"MINE"), "that is no frame"),
        (sealed(version=1), "that is no frame"),
        (sealed(version=3), "that is no frame"),
        (sealed()[:-1] + b"x", "that is damaged"),
        (sealed(count=0), "with 0 commands instead of 1"),
        (sealed(count=2), "with 2 commands instead of 1"),
        (sealed(armed=2), "with an armed flag of 2"),
        (pack(1, 0, True, (nan,)), "with a command that is not finite"),
        (pack(1, 0, True, (inf,)), "with a command that is not finite"),
        (pack(1, 0, True, (1.25,)), "with a command out of 0..1"),
        (pack(1, 0, True, (-0.25,)), "with a command out of 0..1"),
    ],
)
def test_what_is_wrong_is_said_and_stays_wrong(data: bytes, why: str) -> None:
    reader = Reader(1)
    assert [frame.number for frame in reader.feed(sealed())] == [0]
    for more in (data, b"", sealed(number=9)):
        with pytest.raises(FrameError) as caught:
            reader.feed(more)
        assert str(caught.value) == f"a frame {why}"


def test_commands_of_any_size_can_be_sent_to_be_refused() -> None:
    assert pack(3, 1, False, (0.5, 1e300)) == pack(3, 1, False, (inf, inf))


@pytest.mark.parametrize("numbers", [(0, 0), (5, 4), (1, 2, 2)])
def test_numbers_must_rise(numbers: tuple[int, ...]) -> None:
    with pytest.raises(FrameError, match="number"):
        Reader(1).feed(b"".join(pack(number, 0, True, (0.5,)) for number in numbers))


def test_no_robot_drives_for_so_long_that_numbers_run_out() -> None:
    """At a thousand ticks a second 32 bits end after 49.7 days."""
    reader = Reader(1)
    for number in (2**32 - 1, 2**32, 2**63):
        assert [frame.number for frame in reader.feed(pack(number, 0, True, (0.5,)))] == [number]


def test_the_number_of_commands_must_be_that_of_the_actuators() -> None:
    with pytest.raises(FrameError):
        Reader(2).feed(pack(1, 0, True, (0.5, 0.5, 0.5)))


def test_the_longest_frame_is_written_at_once() -> None:
    assert size(MAX_COMMANDS) <= 4096
