"""Pictures say what the kinds say: a ray that meets something is as long as its reading, a mark has its caption."""

import re
from math import isclose
from xml.etree import ElementTree

import pytest

from docs.reference import around, bodies, marks, svg
from docs.reference.of_kinds import OF_KINDS
from mindlang.explaining.kinds import NOUNS, kind_articles

ARTICLES = {(each.noun, each.name): each for each in kind_articles()}
WITHOUT_PICTURE = {  # a number of their own, or of the environment's
    "battery", "broken", "computed", "contact", "held", "inertial", "inside", "light", "mirrored", "observation",
    "observations",
    "order", "position", "reading", "signal", "turned",
}  # fmt: skip
SVG = "{http://www.w3.org/2000/svg}"


def texts(drawn: str) -> list[str]:
    """The words of a picture."""
    return [each.text or "" for each in ElementTree.fromstring(drawn).iter(f"{SVG}text")]


@pytest.mark.parametrize(("noun", "name"), OF_KINDS)
def test_a_picture_is_of_a_kind_and_names_it(noun: str, name: str) -> None:
    assert noun in NOUNS
    drawn = OF_KINDS[noun, name](ARTICLES[noun, name])
    assert drawn == OF_KINDS[noun, name](ARTICLES[noun, name])
    title = ElementTree.fromstring(drawn).findtext(f"{SVG}title") or ""
    assert title.startswith(f"{name}: ")
    said = [value for each in ElementTree.fromstring(drawn).iter() for value in each.attrib.values()]
    assert not [value for value in said if re.search(r"nan|inf|\d\.\d\d", value)]


def test_a_ray_reads_what_it_is_long() -> None:
    """A disc of radius 2 whose middle is 8 ahead of the middle of a robot of radius 1: 5 of 10."""
    drawn = around.rays("rays", (0.0, 1.5), 10.0, [(8.0, 0.0, 2.0)], svg.ROCK)
    assert texts(drawn) == ["0.5", "1"]


def test_a_dial_reads_as_a_bearing_does() -> None:
    said = texts(around.dial("dial", "remark"))
    assert said[0] == "remark"
    for mark in ("0.25", "0.5", "0.75"):
        assert mark in said
    shown = ElementTree.fromstring(around.dial("dial", "")).iter(f"{SVG}text")
    places = {each.text: float(each.get("x", 0)) for each in shown}
    assert places["0.25"] < places["0.5"] < places["0.75"]  # the left is left
    assert places["0"] < places["1"]


def test_every_mark_has_its_caption() -> None:
    article = ARTICLES["actuator", "wheel"]
    assert texts(marks.marks(article, marks.wheel)) == ["0", "full reverse", "0.5", "stopped", "1", "full forward"]


@pytest.mark.parametrize(("value", "sign"), [(0.0, 1), (1.0, -1)])
def test_forward_is_up(value: float, sign: int) -> None:
    shaft = next(each for each in marks.pushed((0.0, 0.0), value) if svg.RED in each)
    end = re.findall(r"-?[\d.]+", shaft.partition("L")[2])[1]
    assert isclose(float(end), sign * marks.ARROW_PIXELS)


def test_text_cannot_break_a_picture() -> None:
    drawn = svg.document(10, 10, [svg.words((0, 0), "a < b & c")], 'a "<" b')
    assert texts(drawn) == ["a < b & c"]


def test_a_body_is_as_large_as_it_says() -> None:
    """Its length, its width, and how far apart its axles are, of that length."""
    assert texts(bodies.disc("disc", 1.5)) == ["1.5"]
    assert sorted(texts(bodies.car("car", (2.5, 1.0), 0.4))) == ["1", "2.5", "40%"]
    long, wide = (bodies.UNIT_PIXELS * each for each in (2.5, 1.0))
    hull = [*ElementTree.fromstring(bodies.box("box", (2.5, 1.0))).iter(f"{SVG}rect")][1]
    assert (float(hull.get("height", 0)), float(hull.get("width", 0))) == (long, wide)


def test_the_wheels_of_a_car_turn_as_one_steers_to_the_left() -> None:
    drawn = bodies.car("car", (3.0, 2.0), 0.6)
    red = re.findall(rf'd="M([\d.]+) [\d.]+ L([\d.]+) [\d.]+"[^>]*{svg.RED}', drawn)
    assert len(red) == 2
    assert all(float(rear) > float(front) for rear, front in red)


def test_what_has_no_picture_is_what_has_nothing_to_draw() -> None:
    """A new body, actuator or sensor gets one, or stands here."""
    drawn = {(each.noun, each.name) for each in kind_articles() if each.noun in ("body", "actuator", "sensor")}
    assert drawn - OF_KINDS.keys() == {
        *(("actuator", name) for name in ("action", "choice", "signal")),
        *(("sensor", name) for name in WITHOUT_PICTURE),
    }
