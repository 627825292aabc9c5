"""Columns in UTF-16 and back, against the bytes that they count."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol.types import Position
from pygls.workspace import PositionCodec

from benchmarks.call_count import CallCount
from mindlang.server.server import EditorSession
from tests.server.client import offset, position

TEXTS = st.text(st.sampled_from("ab é😀\u2028\x85\x0b#\n\r"), max_size=40)
UTF_16 = EditorSession(PositionCodec())


@given(TEXTS, st.data())
def test_utf_16_there_and_back(text, data):
    at = data.draw(st.integers(0, len(text)))
    if text[at - 1 : at + 1] == "\r\n":  # between the two there is no place
        at -= 1
    found = UTF_16.position(text, at)
    place = {"line": found.line, "character": found.character}
    assert place == position(text, at)
    assert UTF_16.offset(text, found) == at == offset(text, place)


@given(TEXTS, st.integers(0, 50), st.integers(0, 50), st.sampled_from(["utf-8", "utf-16", "utf-32"]))
def test_any_place_has_an_offset(text, line, column, encoding):
    assert 0 <= EditorSession(PositionCodec(encoding)).offset(text, Position(line, column)) <= len(text)


@pytest.mark.parametrize(("encoding", "column"), [("utf-8", 7), ("utf-16", 4), ("utf-32", 3)])
def test_what_a_column_counts(encoding, column):
    text = "# a\r\né😀 x"
    assert EditorSession(PositionCodec(encoding)).position(text, 8) == Position(1, column)
    assert EditorSession(PositionCodec(encoding)).offset(text, Position(1, column)) == 8


def test_behind_the_end_of_a_line_is_its_end():
    assert UTF_16.offset("ab\r\ncd", Position(0, 99)) == 2
    assert UTF_16.offset("ab\r\ncd", Position(9, 0)) == 6


def test_half_a_character_is_where_the_next_one_begins():
    assert UTF_16.offset("😀x", Position(0, 1)) == 1


def test_a_long_line_is_walked_once_for_all_of_its_places():
    text = "é" * 1000
    with CallCount(most=20 * len(text)):
        assert [UTF_16.offset(text, UTF_16.position(text, at)) for at in range(len(text))] == [*range(len(text))]
