"""Colours: a light theme for pictures on paper, a dark one for films, in which influence glows."""

Colour = tuple[int, int, int]  # blue, green, red, as OpenCV has them


def colour(code: str) -> Colour:
    red, green, blue = bytes.fromhex(code.removeprefix("#"))
    return blue, green, red


def code(colour: Colour) -> str:
    """#rrggbb."""
    return f"#{bytes(reversed(colour)).hex()}"


def mixed(first: Colour, second: Colour, share: float) -> Colour:
    """`first` with a share of `second`, 0 to 1."""
    share = min(1.0, max(0.0, share))
    blue, green, red = (round(a + (b - a) * share) for a, b in zip(first, second, strict=True))
    return blue, green, red


class Shade:
    """A colour of each theme: on paper, and at night."""

    def __init__(self, paper: str, night: str) -> None:
        self._colours = colour(paper), colour(night)

    def __get__(self, theme: "Theme", owner: type) -> Colour:
        return self._colours[theme.at_night]


# Each on paper, and at night.
SKILLS = (
    "#2878c8 #e0559b #14a39a #d9a404 #7b5cd6 #6b8e23 #c0562f #5b6b7f",
    "#5aa9f0 #f07db8 #3fcfc4 #f2c744 #a58bf5 #a5c94c #f08a5d #93a4bb",
)
THINGS = {
    "item": ("#e8871e #d6409f #c9b200 #8d5a2b", "#ffa040 #ff7ac8 #f2e04a #c98f5a"),
    "zone": ("#3a9d5d #2a8fc7 #93a80f #1fa596", "#4cc97a #56b8f0 #c3d84a #4fd6c8"),
    "power": ("#8e5bd0 #c45bb4 #5468d4 #a3557a", "#b48cff #ea8fdc #8c9dff #d58aad"),
    "box": ("#b07a45 #8c6d5a #a08a3c #7a6f8f", "#d9a066 #b8937a #cdb85c #a497c2"),
    "ball": ("#e05a47 #3f8fb5 #d98a9b #5f9e6e", "#ff7d68 #66b8e0 #ffb0c0 #86cf98"),
    "robot": ("#3d6ea8 #4f8062 #96577f #8a6d3b", "#86b3ec #93c9a5 #dc9fc6 #d3b583"),
    "slope": ("#a08f6a #8a9a86 #9a8796 #7f8c99", "#cdbb90 #b0c4ab #c4aec0 #a5b5c4"),
    "walker": ("#b5473c #7d4fa3 #2f7f86 #8a8420", "#f08a7c #c79bf0 #6fcfd6 #d6cf5a"),
}
NAMED = {
    "red": ("#d7352f", "#ff5a52"),
    "orange": ("#e8871e", "#ffa040"),
    "yellow": ("#d9b400", "#f2e04a"),
    "green": ("#2f9e52", "#4cc97a"),
    "blue": ("#2a6fd0", "#5a9cff"),
    "purple": ("#8e5bd0", "#b48cff"),
    "pink": ("#e0559b", "#ff7ac8"),
    "brown": ("#8d5a2b", "#c98f5a"),
}


class Theme:
    """The colours of a picture, by their use.

    `skills` are for a path by skill, `things` by kind, one each as long as they last, `named` for what is called so.
    """

    page = Shade("#f6f4ef", "#14171c")
    floor = Shade("#fffefb", "#1b1f26")
    grid = Shade("#eeebe3", "#242932")
    wall = Shade("#3b4252", "#79839a")
    rock = Shade("#c3c7cf", "#3d4554")
    rock_edge = Shade("#8b919e", "#606b80")
    ink = Shade("#23272f", "#eceff4")
    faint = Shade("#8a8f99", "#8b94a5")
    robot = Shade("#23272f", "#f4f6fa")
    lamp = Shade("#ffb703", "#ffb703")
    ray = Shade("#e2555f", "#ff6b74")
    crash = Shade("#d62839", "#ff4d5e")
    early = Shade("#a9d6f5", "#1f3a5c")  # a path by time, from
    late = Shade("#123c7c", "#6fb8ff")  # to
    dark = Shade("#dddad2", "#262b34")  # no influence
    glow = Shade("#1f9d4d", "#39ff88")  # full influence

    def __init__(self, at_night: bool) -> None:
        def several(codes: tuple[str, str]) -> tuple[Colour, ...]:
            return tuple(map(colour, codes[at_night].split()))

        self.at_night, self.skills = at_night, several(SKILLS)
        self.things = {kind: several(codes) for kind, codes in THINGS.items()}
        self.named = {name: colour(codes[at_night]) for name, codes in NAMED.items()}


PAPER, NIGHT = Theme(False), Theme(True)
