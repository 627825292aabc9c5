"""What keeps weights from fitting, word by word."""

import pytest

from mindlang.lock import Signature
from mindlang.lock.signature import differences

OLD = Signature("mlp hidden 2 width 14", ("eyes:10", "charge"), ("left", "right"))


@pytest.mark.parametrize(
    ("function", "reads", "sends", "told"),
    [
        ("mlp hidden 2 width 14", "charge eyes:10", "right left", ()),
        ("mlp hidden 3 width 14", "eyes:10 charge", "left right", ("hidden was 2, now 3",)),
        ("mlp hidden 2 width 15", "eyes:10 charge", "left right", ("width was 14, now 15",)),
        ("mlp hidden 2", "eyes:10 charge", "left right", ("width was 14, now not there",)),
        (
            "mlp hidden 2 width 14 bias 1",
            "eyes:10 charge",
            "left right",
            ("bias was not there, now 1",),
        ),
        ("neat", "eyes:10 charge", "left right", ("was mlp, now neat",)),
        ("neat", "eyes:10", "left", ("was mlp, now neat", "reads charge is gone", "sends right is gone")),
        ("mlp hidden 2 width 14", "eyes:9 charge", "left right", ("eyes had 10 readings, now 9",)),
        ("mlp hidden 2 width 14", "eyes:10 charge:2", "left right", ("charge had 1 reading, now 2",)),
        (
            "mlp hidden 2 width 14",
            "eyes:10 moving",
            "left up",
            ("reads moving is new", "reads charge is gone", "sends up is new", "sends right is gone"),
        ),
    ],
)
def test_every_difference_is_told(function: str, reads: str, sends: str, told: tuple[str, ...]) -> None:
    new = Signature(function, tuple(reads.split()), tuple(sends.split()))
    assert sorted(differences(OLD, new, derived=())) == sorted(told)


def test_a_width_that_follows_from_what_is_read_is_not_told_twice() -> None:
    wider = Signature("mlp hidden 2 width 15", ("eyes:11", "charge"), OLD.sends)
    assert differences(OLD, wider, derived=("width",)) == ("eyes had 10 readings, now 11",)
    assert set(differences(OLD, wider, derived=())) == {"eyes had 10 readings, now 11", "width was 14, now 15"}
    alone = Signature("mlp hidden 2 width 15", OLD.reads, OLD.sends)
    assert differences(OLD, alone, derived=("width",)) == ("width was 14, now 15",)
