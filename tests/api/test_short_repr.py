"""A value in a notebook, letter by letter."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.numbers.short_repr import ShortRepr, full_repr


@dataclass(repr=False)
class Value(ShortRepr):
    """One of which a field is not shown."""

    of: Any
    to: Any = None
    hidden: int = field(default=3, repr=False)


def test_texts_are_cut_and_arrays_have_a_shape_and_other_things_a_number() -> None:
    assert repr(Value("x" * 40, "y" * 41)) == f"Value(of='{'x' * 40}', to='{'y' * 39}…')"
    assert repr(Value(Path("/a/b"), True)) == "Value(of='/a/b', to=True)"
    assert repr(Value(1, 0.5)) == "Value(of=1, to=0.5)"
    assert repr(Value(np.zeros((2, 3), np.float32), np.int8(1))) == "Value(of=float32[2, 3], to=int8[])"
    assert repr(Value({"a": 1, "b": 2}, (1, 2, 3))) == "Value(of=[2], to=[3])"
    assert repr(Value(Value(1), iter(()))) == "Value(of=Value, to=tuple_iterator)"
    assert full_repr(Value(Value(1), [1, 2])) == "Value(of=Value(of=1, to=None), to=[1, 2])"


def test_a_line_has_160_letters_at_most() -> None:
    long = 10 ** (160 - len("Value(of=, to=None)") - 1)
    assert repr(Value(long)) == f"Value(of={long}, to=None)"
    assert repr(Value(10 * long)) == f"Value(of={10 * long}, to=None)"[:158] + "…)"
