"""Texts that a page may show."""

from hypothesis import given
from hypothesis import strategies as st

from mindlang.view.messages import SHOWN_CHARACTERS, shown


@given(st.text())
def test_a_text_is_short_and_printable(text: str) -> None:
    assert all(each.isprintable() or each.isspace() for each in shown(text))  # none that moves, hides or turns others
    assert not {"\n", "\r", "\t"} & {*shown(text)}
    assert len(shown(text)) <= SHOWN_CHARACTERS


@given(st.text(st.characters(categories=["L", "N", "P", "S"]), max_size=SHOWN_CHARACTERS))
def test_what_can_be_shown_is_as_it_is(text: str) -> None:
    assert shown(text) == text


def test_directions_are_spelt_out() -> None:
    assert shown("a\u202eb\0") == "a\\u202eb\\u0000"
    assert len(shown("a" * (1 << 20))) == SHOWN_CHARACTERS
