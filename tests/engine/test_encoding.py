"""Graphs and wirings as plain data: what was encoded comes back, and at no place can anything else stand."""

import json
from collections.abc import Iterator
from contextlib import suppress
from copy import deepcopy
from dataclasses import fields, is_dataclass
from math import inf, nan, nextafter
from typing import Any, Literal, get_args, get_origin, get_type_hints

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.errors import BundleError
from mindrun.graph.bundle import decode, decode_wiring
from mindrun.graph.codec import decode_part, encode
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import Wiring
from mindrun.kinds.registry import arguments, kinds, names
from mindrun.kinds.things.thing import Zone
from mindrun.numbers.quantity import Quantity, Span

from tests.draws import cases
from tests.engine.bundles import example, wired
from tests.sim.worlds import random_world

NOUNS = ("actuator", "sensor", "memory", "body", "task", "content", "skill", "event", "measure", "curriculum")
MAY_BE_NOTHING = {"output", "on", "each", "when", "by"}  # fields of which None is a value
ANYTHING: tuple[Any, ...] = (None, True, 7, 0.5, "ball", [[]], [0, 1], {}, {"is": "disc"})
GRAPH, WIRING = (json.loads(json.dumps(encode(part))) for part in (example().graph, wired().wiring))


def read_graph(tree: Any) -> Graph:
    return decode(tree)


def read_wiring(tree: Any) -> Wiring:
    return decode_wiring(tree, wired().graph)


WHOLE = {"graph": (GRAPH, read_graph), "wiring": (WIRING, read_wiring)}
both = pytest.mark.parametrize("name", WHOLE)


def places(tree: Any) -> Iterator[tuple[Any, Any]]:
    """Every place of a JSON tree: what holds it, and its key there."""
    for key in list(tree) if isinstance(tree, dict) else range(len(tree)) if isinstance(tree, list) else ():
        yield tree, key
        yield from places(tree[key])


def well_typed(hint: Any, value: Any) -> bool:
    """Whether a decoded value is of its type through and through."""
    if is_dataclass(value):
        hints = get_type_hints(type(value))
        return all(well_typed(hints[field.name], getattr(value, field.name)) for field in fields(value))
    if isinstance(value, tuple):
        found = [part for part in (hint, *get_args(hint)) if get_origin(part) is tuple]
        of = get_args(found[0]) if found else ()
        hints = [of[0]] * len(value) if of[-1:] == (...,) else list(of)
        return len(hints) == len(value) and all(map(well_typed, hints, value))
    if get_origin(hint) is Literal:
        return value in get_args(hint)
    return type(value) in (hint, *get_args(hint))


@given(random_world(team=True))
@settings(max_examples=cases(40))
def test_whatever_can_be_said_comes_back(graph: Graph) -> None:
    back = decode(json.loads(json.dumps(encode(graph))))
    assert back == graph
    assert well_typed(Graph, back)


@both
def test_what_is_of_another_type_is_refused_anywhere(name: str) -> None:
    """Every place of the JSON holds every other kind of value for once."""
    whole, read = WHOLE[name]
    tree = deepcopy(whole)
    for holder, key in list(places(tree)):
        was = holder[key]
        for value in ANYTHING:
            is_right = type(value) is type(was) or (type(was) is float and type(value) is int)
            if is_right or was is None or (value is None and key in MAY_BE_NOTHING):
                continue
            holder[key] = value
            with pytest.raises(BundleError):
                read(tree)
        holder[key] = was
    assert read(tree) == read(whole)


@both
def test_a_number_is_read_as_one_however_it_is_written(name: str) -> None:
    whole, read = WHOLE[name]
    tree = deepcopy(whole)
    for holder, key in list(places(tree)):
        if type(was := holder[key]) is float and was.is_integer():
            holder[key] = int(was)
            found = read(tree)
            assert found == read(whole)
            assert well_typed(type(found), found)
            holder[key] = was


@both
def test_no_field_may_be_missing_misnamed_or_more(name: str) -> None:
    whole, read = WHOLE[name]
    tree = deepcopy(whole)
    for part in [tree, *(holder[key] for holder, key in places(tree) if isinstance(holder[key], dict))]:
        for key in list(part):
            value = part.pop(key)
            with pytest.raises(BundleError):
                read(tree)
            part[f"{key}_"] = value
            with pytest.raises(BundleError):
                read(tree)
            del part[f"{key}_"]
            part[key] = value
        part["more"] = 1
        with pytest.raises(BundleError):
            read(tree)
        del part["more"]
    assert read(tree) == read(whole)


@both
def test_a_kind_is_what_it_says_and_of_its_noun(name: str) -> None:
    whole, read = WHOLE[name]
    tree = deepcopy(whole)
    for holder in [holder for holder, key in places(tree) if key == "is"]:
        was = holder["is"]
        for kind in sorted({"no.kind", *names().values()} - {was}):
            holder["is"] = kind
            with suppress(BundleError):
                assert encode(read(tree)) == tree
        holder["is"] = "no.kind"
        with pytest.raises(BundleError):
            read(tree)
        holder["is"] = was


@pytest.mark.parametrize("number", [nan, inf, -inf])
def test_no_number_is_infinite_or_none(number: float) -> None:
    tree = deepcopy(GRAPH)
    tree["skills"][0]["edges"][0]["value"] = [["number", number]]
    with pytest.raises(BundleError, match=r"cannot be (nan|inf|-inf)"):
        decode(tree)


def test_a_whole_number_has_at_most_53_bits() -> None:
    tree = deepcopy(GRAPH)
    tree["tasks"][0]["ticks"] = 2**53 - 1
    assert decode(tree).tasks[0].ticks == 2**53 - 1
    for number in (2**53, -(2**53)):
        tree["tasks"][0]["ticks"] = number
        with pytest.raises(BundleError, match="ticks is no number that can be"):
            decode(tree)


@both
def test_no_text_can_have_what_a_terminal_obeys(name: str) -> None:
    whole, read = WHOLE[name]
    tree = deepcopy(whole)
    for holder, key in list(places(tree)):
        if isinstance(was := holder[key], str):
            holder[key] = f"{was}\x1b[2J"
            with pytest.raises(BundleError) as caught:
                read(tree)
            assert "\x1b" not in str(caught.value)
            holder[key] = was


@both
@given(st.data())
@settings(max_examples=cases(300))
def test_what_is_changed_is_refused_or_read_as_it_is(name: str, data: st.DataObject) -> None:
    whole, read = WHOLE[name]
    tree = deepcopy(whole)
    for _ in range(data.draw(st.integers(1, 3))):
        known = list(places(tree))
        (holder, key), (other, there) = (known[data.draw(st.integers(0, len(known) - 1))] for _ in "io")
        anything = st.integers(-3, 10**30) | st.floats() | st.text(max_size=3) | st.sampled_from(ANYTHING)
        holder[key] = deepcopy(other[there]) if data.draw(st.booleans()) else data.draw(anything)
    with suppress(BundleError):
        found = read(tree)
        assert well_typed(type(found), found)
        assert encode(found) == tree


@pytest.mark.parametrize("noun", NOUNS)
def test_every_number_of_every_kind_keeps_to_its_bounds(noun: str) -> None:
    for name, cls in kinds(noun).items():
        given_ = {each.field: _some(each) for each in arguments(cls)}
        for each in arguments(cls):
            if isinstance(each.type, Quantity):
                low, high = each.type.low, each.type.high
                for value in (low, high):
                    part = decode_part(cls, {"is": name, **given_, each.field: _shaped(each.shape, value)}, "kind")
                    assert encode(getattr(part, each.field)) == _shaped(each.shape, value)
                for value in (nextafter(low, -inf), nextafter(high, inf), low - 2, high + 1):
                    with pytest.raises(BundleError, match=f"kind.{each.field}"):
                        decode_part(cls, {"is": name, **given_, each.field: _shaped(each.shape, value)}, "kind")
            elif each.type.words:
                with pytest.raises(BundleError, match=rf"kind.{each.field} cannot be 'no\.word'"):
                    decode_part(cls, {"is": name, **given_, each.field: "no.word"}, "kind")


@pytest.mark.parametrize(
    ("span", "fine"),
    [
        ((0.0, 0.0), True),
        ((1.0, 1e5), True),
        ((1e5, 1e5, 1e5), True),
        ((0.0, 1e5, 1e-9), True),
        ((1e5, 0.0, 3.0), True),
        ((-1.0, -1.0), True),  # not said
        ((2.0, 1.0), False),
        ((0.0, 100001.0), False),
        ((100001.0, 0.0, 1.0), False),
        ((-1.0, 1.0), False),
        ((1.0, -1.0, 1.0), False),
        ((-1.0, -1.0, 1.0), False),
        ((3.0, 1.0, 0.0), False),
        ((3.0, 1.0, -1.0), False),
        ((3.0, 1.0, 100001.0), False),
    ],
)
def test_a_range_keeps_to_the_bounds_of_its_lengths(span: tuple[float, ...], fine: bool) -> None:
    kind = encode(Zone(away=Span(*span)))
    if fine:
        assert decode_part(Zone, kind, "kind") == Zone(away=Span(*span))
    else:
        with pytest.raises(BundleError, match=r"kind\.away"):
            decode_part(Zone, kind, "kind")


def _some(argument: Any) -> Any:
    if isinstance(argument.type, Quantity):
        return _shaped(argument.shape, argument.type.low)
    word = argument.type.words[0] if argument.type.words else "a.b"
    return [word] if argument.shape == "lines" else word


def _shaped(shape: str, value: float) -> Any:
    value = int(value) if isinstance(value, float) and value.is_integer() and shape in ("one", "list") else value
    span = {"first": value, "last": value, "by": None}
    return {
        "one": value,
        "extent": value,
        "list": [value],
        "place": [value, value],
        "places": [[value, value]],
        "alternatives": [[[value, value]]],
        "span": span,
    }[shape]
