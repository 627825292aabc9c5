"""The known word that is told to whoever has written another one: the one that was meant, or none."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from mindrun.errors import nearest

KNOWN = ("battery", "bearing_of", "left_wheel", "Collect", "eye", "range_finder", "reward")
WORDS = st.text("abcdwxyz_", min_size=5, max_size=9)


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("COLLECT", "Collect"),
        ("collects", "Collect"),
        ("rewards", "reward"),
        ("eyes", "eye"),
        ("aye", "eye"),
        ("ey", "eye"),
        ("ye", "eye"),  # the first letter is missing
        ("yee", "eye"),  # two are exchanged
        ("battrey", "battery"),
        ("tabtery", None),  # two mistakes behind another first letter
        ("batttry", "battery"),
        ("bettary", "battery"),  # two of seven
        ("bottory", "battery"),
        ("bitturi", None),  # three of seven
        ("bearing", "bearing_of"),  # it begins with it
        ("finder", "range_finder"),  # it ends with it
        ("left", None),  # it begins with it, but that is far from all of it
        ("left_side", "left_wheel"),  # they have a part in common
        ("lift_wheels", "left_wheel"),
        ("bearing_at", "bearing_of"),
        ("bearings", "bearing_of"),  # three mistakes of ten
        ("nothing", None),
        ("", None),
    ],
)
def test_what_is_meant(word: str, meant: str | None) -> None:
    assert nearest(word, KNOWN) == meant


def test_of_two_the_one_that_is_more_alike_is_meant() -> None:
    assert nearest("batery", ["batter", "battery", "bat"]) == "battery"
    assert nearest("xabcde", ["abcdx", "xbdcae", "xabcdef"]) == "xabcdef"


def test_a_part_in_common_has_three_letters() -> None:
    assert nearest("to_abxyz", ["to_abklm"]) is None
    assert nearest("toa_bxyz", ["toa_bklm"]) == "toa_bklm"
    assert nearest("abcd", ["ab"]) is None
    assert nearest("abcde", ["abc"]) == "abc"


@given(WORDS, st.data())
def test_one_mistake_is_forgiven_wherever_it_is(word: str, data: st.DataObject) -> None:
    at, other = data.draw(st.integers(0, len(word) - 2)), data.draw(st.sampled_from("klm"))
    before, here, following, behind = word[:at], word[at], word[at + 1], word[at + 2 :]
    wrong, missing = before + other + following + behind, before + following + behind
    for said in (wrong, missing, before + other + word[at:], before + following + here + behind, word + other):
        assert nearest(said, [word]) == word


@given(st.permutations("abcdefgh").map("".join), st.data())
def test_two_mistakes_are_forgiven_behind_the_same_first_letter(word: str, data: st.DataObject) -> None:
    first, second = sorted(data.draw(st.lists(st.integers(1, len(word) - 1), min_size=2, max_size=2, unique=True)))
    said = "".join("xy"[i == second] if i in (first, second) else letter for i, letter in enumerate(word))
    assert nearest(said, [word]) == word
    assert nearest("z" + said[1:], ["k" + word[1:]]) is None


@given(st.text("ab_é", max_size=150), st.lists(st.text("AB_ß", max_size=150), max_size=4))
def test_any_word_may_be_asked_for(word: str, known: list[str]) -> None:
    assert nearest(word, known) in (None, *known)
    assume(known and known[0])
    assert nearest(known[0].lower(), known[:1]) == known[0]
