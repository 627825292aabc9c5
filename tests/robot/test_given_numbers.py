"""What a driver or a procedure may give: whatever is a number is one, and nothing else; robots take what runs do."""

from array import array
from collections import deque
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from math import inf, isfinite, nan
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.errors import ProcedureError
from mindrun.graph.wiring import SensorWire
from mindrun.kinds.procedure_call import call
from mindrun.robot.drivers.mock import MockSensor
from mindrun.robot.drivers.own import CheckedActuatorDevice
from mindrun.robot.sensing import Sample, checked


class Floats:
    """A number of nobody's library."""

    def __init__(self, value: float) -> None:
        self.value = value

    def __float__(self) -> float:
        return self.value


class Indexes:
    """A whole one."""

    def __init__(self, value: int) -> None:
        self.value = value

    def __index__(self) -> int:
        return self.value


SCALARS: tuple[Callable[[float], Any], ...] = (
    float, np.float64, np.float32, np.float16, np.longdouble, np.array, Fraction, Decimal, Floats,
    lambda value: np.array(value, np.float32), lambda value: np.array([value])[0],
)  # fmt: skip
WHOLE: tuple[Callable[[float], Any], ...] = (
    int, np.int64, np.int8, np.uint8, lambda value: np.array(int(value)), lambda value: Indexes(int(value))
)  # fmt: skip
LISTS: tuple[Callable[[list[Any]], Any], ...] = (
    list, tuple, deque, lambda values: np.array([float(value) for value in values]),
    lambda values: np.array(values, object), lambda values: np.array([[float(value)] for value in values], np.float32),
    lambda values: array("d", [float(value) if hasattr(value, "__float__") else int(value) for value in values]),
)  # fmt: skip
NONE = ("0.5", b"1", True, False, np.True_, np.array(True), 1j, np.complex64(1), [0.5], np.array([0.5]), {}, object,
        np.datetime64(1, "s"), np.timedelta64(1, "s"), np.array("1"), np.str_("1"), range, lambda: 1.0)  # fmt: skip
QUARTERS = st.integers(0, 4).map(lambda count: count / 4)  # exact in every type


def sampled(what: object, count: int) -> Sample:
    return checked(what, 1.0, SensorWire("sense", MockSensor(count=count), 0.0, 1.0))


def returned(what: object, count: int) -> list[float]:
    found: list[float] = call("own.f", lambda *inputs: what, count, np.zeros(1, np.float32)).tolist()
    return found


@given(st.data())
def test_whatever_is_a_number_is_one(data: st.DataObject) -> None:
    plain, wrapped = [], []
    for _ in range(data.draw(st.integers(1, 5))):
        if data.draw(st.booleans()):
            plain.append(data.draw(QUARTERS))
            wrapped.append(data.draw(st.sampled_from(SCALARS))(plain[-1]))
        else:
            plain.append(float(data.draw(st.integers(0, 1))))
            wrapped.append(data.draw(st.sampled_from(WHOLE))(plain[-1]))
    lists = LISTS if not any(isinstance(value, Indexes) for value in wrapped) else LISTS[:3]
    whole = data.draw(st.sampled_from(lists))(wrapped)
    sample = sampled(whole, len(plain))
    assert (sample.fault, list(sample.values)) == ("", plain)
    assert {type(value) for value in sample.values} == {float}
    assert returned(whole, len(plain)) == plain
    assert returned(wrapped[0], 1) == plain[:1]
    assert f"not a list of {len(plain) + 1} values" in sampled(whole, len(plain) + 1).fault
    with pytest.raises(ProcedureError, match=f"returned {len(plain)} values instead of {len(plain) + 1}"):
        returned(whole, len(plain) + 1)


@given(st.sampled_from(SCALARS[:4] + SCALARS[8:]), st.sampled_from([nan, inf, -inf]), st.sampled_from(LISTS[:4]))
def test_what_is_not_finite_is_a_fault(wrap: Callable[[float], Any], value: float, listed: Callable[..., Any]) -> None:
    assert sampled(listed([wrap(value), 0.5]), 2).fault == f"gave {value}"
    assert not isfinite(returned(listed([wrap(value)]), 1)[0])  # which the engine does not send


@pytest.mark.parametrize("value", NONE)
def test_what_is_no_number_is_a_fault(value: object) -> None:
    assert sampled((value,), 1).fault == f"gave {value!r:.60}, which is no number"
    if isinstance(value, bool | np.bool_):
        assert returned([value], 1) == [float(value)]
    elif not isinstance(value, np.ndarray) or value.dtype != bool:
        with pytest.raises(ProcedureError, match="is no number"):
            returned((value,), 1)


@pytest.mark.parametrize("whole", [0.5, np.float32(0.5), np.array(0.5), "0", b"0", None, {0.5: 1}, {0.5}, iter([0.5])])
def test_what_is_no_list_is_a_fault_of_a_driver(whole: object) -> None:
    assert sampled(whole, 1).fault == f"gave {whole!r:.60}, not a list of 1 value"


def test_nothing_measured_is_no_fault() -> None:
    assert sampled(np.array([None, 1], object), 2).values == (None, 1.0)


@given(st.sampled_from(SCALARS[:4]), QUARTERS)
def test_a_device_is_told_plain_floats(wrap: Callable[[float], Any], value: float) -> None:
    told: list[float] = []

    class Device:
        write, close = told.append, lambda self: None

    CheckedActuatorDevice(Device()).write(wrap(value))  # type: ignore[arg-type]
    assert (told, type(told[0])) == ([value], float)
