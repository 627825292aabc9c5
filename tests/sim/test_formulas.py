"""A formula is what Python computes, whatever stands in it; what is no formula is found out before it is compiled."""

import math
import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.kinds.procedure_call import load
from mindrun.sim.exact import OPERATIONS, exactly
from mindrun.sim.formulas import NoFormulaError, formula

from tests.draws import cases

HEAD = "import math\nfrom math import sin, pi as PI\nGAIN, STEPS, ON = 0.3, 7, True\n"
NUMBERS = (
    "0",
    "1",
    "-1",
    "2",
    "3",
    "0.5",
    "1e-300",
    "1e300",
    "9007199254740993",
    "7.25",
    "True",
    "GAIN",
    "STEPS",
    "ON",
)
NAMES = ("a", "b", "x", "y", "PI", "math.e", "math.inf", "math.nan")
FUNCTIONS = ("abs", "float", "math.sqrt", "math.exp", "math.log", "sin", "math.tan", "math.acos", "math.tanh")

leaves = st.sampled_from((*NUMBERS, *NAMES, *"ababab"))


def calculated(terms: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Terms of terms."""
    return st.one_of(
        st.builds("({} {} {})".format, terms, st.sampled_from(["+", "-", "*", "/", "%", "//", "<<"]), terms),
        st.builds("({} {} {})".format, terms, st.sampled_from(["<", "<=", ">", ">=", "==", "and", "or"]), terms),
        st.builds("({} < {} <= {})".format, terms, terms, terms),
        st.builds("({} ** {})".format, terms, st.sampled_from(["2", "3", "-1", "-2", "0", "0.5", "a", "63"])),
        st.builds("({}{})".format, st.sampled_from(["-", "+", "not ", "~"]), terms),
        st.builds("({} if {} else {})".format, terms, terms, terms),
        st.builds("{}({})".format, st.sampled_from((*FUNCTIONS, "round", "int", "math.floor")), terms),
        st.builds("{}({}, {})".format, st.sampled_from(["min", "max", "math.atan2"]), terms, terms),
        st.builds("max({}, {}, {})".format, terms, terms, terms),
    )


terms = st.recursive(leaves, calculated, max_leaves=6)


@st.composite
def functions(draw: st.DrawFn) -> str:
    """A function of a and b, of few lines, that gives two numbers."""
    lines = []
    for _ in range(draw(st.integers(0, 4))):
        name, value = draw(st.sampled_from("abxy")), draw(terms)
        match draw(st.integers(0, 5)):
            case 0:
                lines += [f"if {value}:", f"    {name} = {draw(terms)}"]
                lines += ["else:", f"    {name} = {draw(terms)}"] * draw(st.booleans())
            case 1:
                lines += [f"if {value}: raise ValueError('no')"]
            case 2:
                lines += [f"assert {value}"]
            case 3:
                lines += [f"a, {name} = {draw(terms)}, {value}"]
            case 4:
                lines += [f"{name} += {value}"]
            case _:
                lines += [f"{name} = {value}"]
    lines.append(f"return {draw(terms)}, {draw(terms)}")
    return "\n    ".join([f"{HEAD}def f(a, b):", *lines])


readings = st.floats(0, 1, width=32) | st.sampled_from([0.0, 1.0, 0.5])


def of_python(function: Any, inputs: tuple[float, float]) -> tuple[float, ...] | None:
    """What Python computes, None where it raises."""
    try:
        return tuple(float(value) for value in function(*inputs))
    except Exception:
        return None


def bits(values: tuple[float, ...]) -> list[bytes]:
    """Numbers by their bits; a zero has no sign, and one NaN is as good as another."""
    return [struct.pack("d", math.nan if value != value else value + 0.0) for value in values]


def check(source: str, inputs: list[tuple[float, float]], *, is_compiled: bool) -> bool:
    """Whether a text is a formula; and that it then is what Python computes."""
    function = load("m.f", {"m": source})
    try:
        made = formula(function, source, 2, 2)
    except NoFormulaError:
        return False
    if is_compiled:
        made = exactly(made)
    else:
        made.__globals__.update({name: getattr(made_of, "py_func", made_of) for name, made_of in OPERATIONS.items()})
    for given_now in inputs:
        wrong = np.zeros(1, np.int64)
        found, expected = made(wrong, *given_now), of_python(function, given_now)
        assert (expected is None) == bool(wrong[0]), (source, given_now, expected)
        assert expected is None or bits(found) == bits(expected), (source, given_now)
    return True


@given(source=functions(), inputs=st.lists(st.tuples(readings, readings), min_size=1, max_size=5))
@settings(max_examples=cases(100), deadline=None)
def test_a_formula_means_what_python_means(source: str, inputs: list[tuple[float, float]]) -> None:
    check(source, inputs, is_compiled=False)


@given(source=functions(), inputs=st.lists(st.tuples(readings, readings), min_size=5, max_size=5))
@settings(max_examples=5, deadline=None)
def test_a_compiled_formula_has_the_bits_of_python(source: str, inputs: list[tuple[float, float]]) -> None:
    check(source, inputs, is_compiled=True)


@pytest.mark.slow
@given(source=functions(), inputs=st.lists(st.tuples(readings, readings), min_size=20, max_size=40))
@settings(max_examples=cases(1000), deadline=None)
def test_many_compiled_formulas_have_the_bits_of_python(source: str, inputs: list[tuple[float, float]]) -> None:
    check(source, inputs, is_compiled=True)


CLAMP = "min(1, max(0, 0.5 + GAIN * (a - b)))"


@pytest.mark.parametrize(
    "lines",
    [
        f"return {CLAMP}, 1 - {CLAMP}",
        "return 0.9, 0.1",
        "return [a * 2 / STEPS, not b]",
        "'''About it.'''\n    x = 0\n    if a < 0.5:\n        x = b\n    x += 1\n    return x, x ** 2",
        "if a < 0.5:\n        return 1, 0\n    elif b:\n        return b, a\n    raise ValueError(a)",
        "x = math.sin(a * math.pi) % 0.3\n    return x, (a < b <= 1) * 0.5",
    ],
)
def test_what_a_controller_is_made_of_is_a_formula(lines: str) -> None:
    assert check(f"{HEAD}def f(a, b):\n    {lines}\n", [(0.25, 0.5), (1.0, 0.0), (0.0, 0.0)], is_compiled=True)


@pytest.mark.parametrize(
    ("source", "why"),
    [
        ("def f(a, b):\n    return 2 ** -int(a), b", "more than arithmetic"),
        ("def f(a, b):\n    return 1 << 70, b", "more than arithmetic"),
        ("def f(a, b):\n    return a * 9007199254740993, b", "`9007199254740993` in line 2 is more than"),
        ("N = 0\ndef f(a, b):\n    global N\n    N += 1\n    return N, b", "more than arithmetic"),
        ("N = 0\nN = 1\ndef f(a, b):\n    return N * a, b", "`N` in line 4"),
        ("import numpy as np\nA = np.zeros(3)\ndef f(a, b):\n    A[int(a * 1e5)] = 5.0\n    return a, b", "`A[int"),
        ("def f(a, b):\n    if a > 0.5:\n        x = b\n    return x, b", "`x` in line 4"),
        ("def f(a, b):\n    if a > 0.5:\n        return a, b", "does not always return"),
        ("def f(a, b):\n    return a", "does not return 2 numbers"),
        ("def f(a, b=1):\n    return a, b", "does not take just 2"),
        ("def g(a, b):\n    return a, b\nf = lambda a, b: g(a, b)", "no plain function"),
        ("def f(a, b):\n    while True:\n        pass", "more than arithmetic"),
        ("def f(a, b):\n    return math, b\nimport math", "`math` in line 2"),
    ],
)
def test_what_is_no_formula_says_why(source: str, why: str) -> None:
    function = load("m.f", {"m": source})
    with pytest.raises(NoFormulaError, match=why.replace("[", r"\[")):
        formula(function, source, 2, 2)
