"""Colours: a light theme for pictures on paper, a dark one for films, in which influence glows."""

from collections.abc import Mapping
from dataclasses import dataclass

Colour = tuple[int, int, int]  # blue, green, red, as OpenCV has them


def colour(code: str) -> Colour:
    """The colour of a code #rrggbb."""
    red, green, blue = (int(code[i : i + 2], 16) for i in (1, 3, 5))
    return blue, green, red


def colours(*codes: str) -> tuple[Colour, ...]:
    """The colours of some codes."""
    return tuple(colour(code) for code in codes)


def mixed(first: Colour, second: Colour, share: float) -> Colour:
    """`first` with a share of `second`, 0 to 1."""
    share = min(1.0, max(0.0, share))
    blue, green, red = (round(a + (b - a) * share) for a, b in zip(first, second, strict=True))
    return blue, green, red


@dataclass(frozen=True, slots=True)
class Theme:
    """What has which colour."""

    page: Colour
    floor: Colour
    grid: Colour
    wall: Colour
    rock: Colour
    rock_edge: Colour
    ink: Colour
    faint: Colour
    things: Mapping[str, tuple[Colour, ...]]  # by kind: one each, as long as they last
    named: Mapping[str, Colour]  # of things that are called by their colour
    robot: Colour
    lamp: Colour
    ray: Colour
    crash: Colour
    early: Colour  # a path by time, from
    late: Colour  # to
    skills: tuple[Colour, ...]  # a path by skill
    dark: Colour  # no influence
    glow: Colour  # full influence


PAPER = Theme(
    page=colour("#f6f4ef"),
    floor=colour("#fffefb"),
    grid=colour("#eeebe3"),
    wall=colour("#3b4252"),
    rock=colour("#c3c7cf"),
    rock_edge=colour("#8b919e"),
    ink=colour("#23272f"),
    faint=colour("#8a8f99"),
    things={
        "item": colours("#e8871e", "#d6409f", "#c9b200", "#8d5a2b"),
        "zone": colours("#3a9d5d", "#2a8fc7", "#93a80f", "#1fa596"),
        "power": colours("#8e5bd0", "#c45bb4", "#5468d4", "#a3557a"),
        "box": colours("#b07a45", "#8c6d5a", "#a08a3c", "#7a6f8f"),
        "ball": colours("#e05a47", "#3f8fb5", "#d98a9b", "#5f9e6e"),
        "walker": colours("#b5473c", "#7d4fa3", "#2f7f86", "#8a8420"),
    },
    named={
        "red": colour("#d7352f"),
        "orange": colour("#e8871e"),
        "yellow": colour("#d9b400"),
        "green": colour("#2f9e52"),
        "blue": colour("#2a6fd0"),
        "purple": colour("#8e5bd0"),
        "pink": colour("#e0559b"),
        "brown": colour("#8d5a2b"),
    },
    robot=colour("#23272f"),
    lamp=colour("#ffb703"),
    ray=colour("#e2555f"),
    crash=colour("#d62839"),
    early=colour("#a9d6f5"),
    late=colour("#123c7c"),
    skills=colours("#2878c8", "#e0559b", "#14a39a", "#d9a404", "#7b5cd6", "#6b8e23", "#c0562f", "#5b6b7f"),
    dark=colour("#dddad2"),
    glow=colour("#1f9d4d"),
)
NIGHT = Theme(
    page=colour("#14171c"),
    floor=colour("#1b1f26"),
    grid=colour("#242932"),
    wall=colour("#79839a"),
    rock=colour("#3d4554"),
    rock_edge=colour("#606b80"),
    ink=colour("#eceff4"),
    faint=colour("#8b94a5"),
    things={
        "item": colours("#ffa040", "#ff7ac8", "#f2e04a", "#c98f5a"),
        "zone": colours("#4cc97a", "#56b8f0", "#c3d84a", "#4fd6c8"),
        "power": colours("#b48cff", "#ea8fdc", "#8c9dff", "#d58aad"),
        "box": colours("#d9a066", "#b8937a", "#cdb85c", "#a497c2"),
        "ball": colours("#ff7d68", "#66b8e0", "#ffb0c0", "#86cf98"),
        "walker": colours("#f08a7c", "#c79bf0", "#6fcfd6", "#d6cf5a"),
    },
    named={
        "red": colour("#ff5a52"),
        "orange": colour("#ffa040"),
        "yellow": colour("#f2e04a"),
        "green": colour("#4cc97a"),
        "blue": colour("#5a9cff"),
        "purple": colour("#b48cff"),
        "pink": colour("#ff7ac8"),
        "brown": colour("#c98f5a"),
    },
    robot=colour("#f4f6fa"),
    lamp=colour("#ffb703"),
    ray=colour("#ff6b74"),
    crash=colour("#ff4d5e"),
    early=colour("#1f3a5c"),
    late=colour("#6fb8ff"),
    skills=colours("#5aa9f0", "#f07db8", "#3fcfc4", "#f2c744", "#a58bf5", "#a5c94c", "#f08a5d", "#93a4bb"),
    dark=colour("#262b34"),
    glow=colour("#39ff88"),
)
