"""Columns in UTF-16 and back, against the bytes that they count."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol.types import Position
from pygls.workspace import PositionCodec

from mindlang.server.server import TextLines
from tests.server.client import offset, position

TEXTS = st.text(st.sampled_from("ab é😀\u2028\x85\x0b#\n\r"), max_size=40)
UTF_16 = PositionCodec()


@given(TEXTS, st.data())
def test_utf_16_there_and_back(text, data):
    at = data.draw(st.integers(0, len(text)))
    if text[at - 1 : at + 1] == "\r\n":  # between the two there is no place
        at -= 1
    found = TextLines(text).position(at, UTF_16)
    place = {"line": found.line, "character": found.character}
    assert place == position(text, at)
    assert TextLines(text).offset(found, UTF_16) == at == offset(text, place)


@given(TEXTS, st.integers(0, 50), st.integers(0, 50), st.sampled_from(["utf-8", "utf-16", "utf-32"]))
def test_any_place_has_an_offset(text, line, column, encoding):
    assert 0 <= TextLines(text).offset(Position(line, column), PositionCodec(encoding)) <= len(text)


@pytest.mark.parametrize(("encoding", "column"), [("utf-8", 7), ("utf-16", 4), ("utf-32", 3)])
def test_what_a_column_counts(encoding, column):
    text = "# a\r\né😀 x"
    assert TextLines(text).position(8, PositionCodec(encoding)) == Position(1, column)
    assert TextLines(text).offset(Position(1, column), PositionCodec(encoding)) == 8


def test_behind_the_end_of_a_line_is_its_end():
    assert TextLines("ab\r\ncd").offset(Position(0, 99), UTF_16) == 2
    assert TextLines("ab\r\ncd").offset(Position(9, 0), UTF_16) == 6


def test_half_a_character_is_where_the_next_one_begins():
    assert TextLines("😀x").offset(Position(0, 1), UTF_16) == 1
