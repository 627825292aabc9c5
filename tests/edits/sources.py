"""Hypothesis strategies for the texts of whole hierarchies, as people write them."""

import re
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from random import Random

from hypothesis import strategies as st
from mindrun.kinds.registry import Argument, arguments, kinds
from mindrun.numbers.quantity import Reference

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.source import Source
from mindlang.editing.project import Project, open_project
from tests.edits.sensors import NARROW, SENSORS

FOLDER = Path("/nowhere/minds")
MAIN, PARTS = FOLDER / "main.mind", FOLDER / "parts.mind"
SKILLS = ("Go", "Avoid", "Go+Avoid", "Collect", "Fetch", "Grab", "Wait")
LIKE = "GoHome"  # the skill that is like another, where there is one
STEPS = "skill StepN is mlp where N is 1 to 3"  # a family, where there is one
FUNCTIONS = (
    "mlp hidden 2",
    "mlp hidden 1 width 4 bias 1 centred 1",
    "mlp",
    "elman",
    "elman width 3 bias 1 centred 1",
    "gru",
    "gru width 3 bias 1 centred 1",
    "ctrnn",
    "ctrnn width 3",
    "neat",
    "neat most 2 links any bias 0 centred 1",
    "procedure from own.by",
    "procedure from own.to",
)
CLAW = ["actuator claw is gripper neutral 0", "actuator claw is gripper neutral 10%"]
MAST = [
    "actuator mast is servo neutral 0.5",
    "actuator mast is servo neutral 1/4",
    "actuator mast is lamp neutral 0",
    "actuator mast is lamp neutral 10%",
    "actuator mast is signal neutral 0",
    "actuator mast is signal neutral 10% delay 2 ticks",
]
SERVOS = {
    "pan": ["actuator pan is servo neutral 0.5", "actuator pan is servo neutral 1/2 range 45 deg speed 90 deg per s"],
    "tilt": ["actuator tilt is servo neutral 50% speed 2 deg"],
}
WHEELS = {
    "left_wheel": [
        "actuator left_wheel is wheel side left thrust 80 neutral 0.5",
        "actuator left_wheel is wheel side left neutral 0.4",
    ],
    "right_wheel": ["actuator right_wheel is wheel neutral 50% side right"],
}
THRUSTERS = {
    "left_wheel": ["actuator left_wheel is thruster at 0 1 facing 90 deg neutral 0.5"],
    "right_wheel": ["actuator right_wheel is thruster neutral 50%", "actuator right_wheel is thruster neutral 0.4"],
}
STEERED = {
    "left_wheel": ["actuator left_wheel is steering neutral 0.5", "actuator left_wheel is steering neutral 0.4"],
    "right_wheel": ["actuator right_wheel is motor neutral 50%", "actuator right_wheel is motor neutral 0.6"],
}
ROBOTS = [  # a body, and what moves it
    ("body Robot is disc size 2", WHEELS),
    ("body Robot is disc density 2 size 1.5", WHEELS),
    ("body Robot is box", WHEELS),
    ("body Robot is box size 2 1", WHEELS),
    ("body Robot is holonomic", THRUSTERS),
    ("body Robot is holonomic size 1.5", THRUSTERS),
    ("body Robot is car", STEERED),
    ("body Robot is car size 2 1.5", STEERED),
]
ACTUATORS = {**WHEELS, **SERVOS, "claw": CLAW, "mast": MAST}
SCENES = ["plain", "arena size 40", "arena", "arena size 60 50"]
ROCKS = [
    "rock is obstacle grid 10 size 2 to 3",
    "rock is obstacle count 3",
    "rock is obstacle size 2 at 15 -15",
    "rock is obstacle size 2 at 15 -15 or 15 15",
    "fence is wall from -14 -18 to 3 -18 to 3 -19",
    "fence is wall from 4 -16 to 4 -18",
]
THINGS = [
    ["ball is item size 2 reached moves", "ball is item size 2 at 2.5 7.5", "ball is item at 2.5 7.5 or -2.5 12.5"],
    ["coin is item", "coin is item at 7.5 12.5", "coin is item within nest"],
    ["nest is zone size 8", "nest is zone at -12.5 7.5", "nest is zone at -12.5 7.5 or -12.5 2.5"],
    ["dock is power size 4", "dock is power at -2.5 -7.5 or -7.5 -7.5", "dock is power within -9 -9 to 0 -3"],
    [
        *("crate is box size 2", "crate is box at 12.5 -2.5 or 12.5 2.5", "crate is box within nest"),
        *("crate is ball", "crate is ball at -7.5 -12.5 or -2.5 -12.5", "crate is ball within 9 -9 to 14 9"),
        *("crate is box size 2 seeks robot thrust 20", "crate is ball size 2 seeks robot speed 3"),
        *("crate is box size 2 flees robot range 9", "crate is ball size 2 flees robot range 9 thrust 5"),
        *("crate is box size 1 seeks crate range 20", "crate is ball size 1 flees crate"),
        *("crate is box size 1 flees crate", "crate is ball size 1 seeks crate range 20"),
    ],
    [
        *("cat is walker size 2", "cat is walker at 2.5 2.5 or 7.5 2.5", "cat is walker within nest"),
        "cat is walker along 2.5 -2.5 to 7.5 -2.5",
        "cat is walker along 2.5 -2.5 to 7.5 -2.5 or 2.5 2.5 to 7.5 2.5 from anywhere",
        *("cat is walker seeks robot", "cat is walker flees robot range 9", "cat is walker seeks cat range 20"),
        "cat is walker flees cat",
    ],
    [
        "ramp is slope size 4",
        "ramp is slope at 12.5 7.5 facing 90 deg slides 2",
        "ramp is slope at 12.5 7.5 or 7.5 12.5 pull 20",
        "ramp is slope within nest",
    ],
    ["kin is robot count 0", "kin is robot at 7.5 -12.5"],
    ["mate is robot", "mate is robot at -12.5 -7.5", "mate is robot at -12.5 -7.5 or 12.5 12.5"],
]
DRAWN = [
    [
        "draws side from -5 5",
        "contains pit is zone size 2 at side / 2 - 1 17 when side > 0",
        "rewards 0.1 * side per tick",
    ],
    ["draws far from 1 to 4.5", "contains pit is zone within -9 15 to 9 17", "ends when far > 4"],
]  # what is drawn, and what depends on it
STARTS = ["starts at 2.5 12.5", "starts facing -45 deg", "starts at 2.5 12.5 facing 1/2 deg"]
SPREADS = [
    ["varies noise of eye 0 to 10%", "varies lost of ball_bearing 0 to 5%", "varies delay of moving 0 to 2 ticks"],
    ["varies density of Robot 1 to 3", "varies noise of left_wheel 0 to 1/4"],
    ["varies density of crate 0.5 to 1", "varies speed of cat 1 to 3", "varies delay of right_wheel 1 to 3 ticks"],
    ["fails left_wheel 1% per s", "fails claw 0.1% per tick"],
    ["fails mast 0.01"],
]
NEEDS = ["score > 3", "2 reach of ball"]
UNTIL = ["for", *(f"until {need} for at most" for need in NEEDS)]
REWARDS = [
    ["rewards 10 on reach of ball"],
    ["rewards 0.01 * forward per tick"],
    ["rewards -0.03 * (1 - 4 * p) per tick for each p in eye when p < 1/4"],
    ["rewards 0.001 * progress toward ball per tick when charge > 0.5", "rewards charge / 2 per tick"],
    ["rewards 0.1 * progress toward nest per tick", "rewards 1 on reach of dock"],
    ["rewards 0.1 * advance toward ball per tick", "rewards 0.1 * advance toward dock per tick"],
    ["rewards -0.1 * retreat from ball per tick", "rewards -0.1 * retreat from nest per tick"],
    ["rewards -0.4 * change of thrust per tick", "rewards -0.4 * change of thrust beyond 20% over 4 ticks per tick"],
    ["rewards (count of reach of ball when charge > 0.5) / time at the end", "rewards (sum of moving) at the end"],
    ["rewards -0.01 * claw per tick when charge > 0.5 and moving < 0.9 or holding > 0.5"],
    ["rewards 0.1 * progress of ball toward nest per tick", "rewards 0.1 * progress of coin toward dock per tick"],
    ["rewards 0.1 * advance of coin toward ball per tick", "rewards 0.1 * advance of ball toward dock per tick"],
    ["rewards -0.1 * retreat of ball from nest per tick", "rewards -0.1 * retreat of coin from dock per tick"],
    ["rewards -0.1 * distance of ball to nest per tick", "rewards -0.1 * distance of coin to ball per tick"],
    ["rewards 5 on reach of nest by ball", "rewards 5 on reach of ball by coin", "rewards 5 on leave of dock"],
    ["rewards -5 on leave of nest by ball", "rewards -5 on leave of dock by coin"],
    ["rewards -20 on collision with mate", "rewards 1 on reach of mate within 2 s of collision with mate"],
    ["rewards 50 on delivery of ball", "rewards 50 on delivery of coin to nest"],
    [
        "rewards 7 on reach of nest within 2 s of reach of dock",
        "rewards 7 on collision within 9 ticks of reach of ball",
    ],
]
GATES = [" when {} < 0.7", " when {} > 0.2 and 1 > 0.5 otherwise 0.3"]
VISITS = ["rewards 1 on visit of patch", "rewards 1 on visit of patch size 8"]
WORDS = ("note", "why?", "skill Go is rule", "  spaced  out", "é – “x”", "reads charge", "stays frozen", "#")


@dataclass(frozen=True, slots=True)
class Texts:
    """The texts of a mind by path, the main one first; `airy` where blank lines set off all its declarations."""

    files: dict[Path, str]
    airy: bool

    def compiled(self) -> Compiled:
        """The mind compiled; nothing is on a disk."""
        return compile_source(Source(MAIN.name, self.files[MAIN], FOLDER), MAIN, self.files)

    def project(self) -> Project:
        """The mind as an edit takes it."""
        return open_project(self.compiled())

    def changed(self, texts: dict[Path, str]) -> "Texts":
        """The texts with others in their place."""
        return Texts(self.files | texts, self.airy)


def minds() -> st.SearchStrategy[Texts]:
    """Minds that compile."""
    # seeds, and not every choice by itself: the texts are longer than what Hypothesis takes apart
    return st.integers(0, 2**32 - 1).map(lambda seed: a_mind(Random(seed)))


def a_mind(rng: Random) -> Texts:
    """A mind that compiles: one file or two, with LF or CRLF, with or without an end of its last line."""
    declared = _declarations(rng)
    rng.shuffle(declared)
    apart = [lines for lines in declared if rng.random() < 0.3] if rng.random() < 0.3 else []
    settings = [
        ["tick 1/60 s"],
        [f"master {rng.choice([_name(lines) for lines in declared if _noun(lines) == 'skill' and lines[0] != STEPS])}"],
    ]
    main = [*settings, *([['use "parts.mind"']] if apart else []), *(lines for lines in declared if lines not in apart)]
    style, numbers = _Style(rng), count()
    files = {MAIN: _written(main, style, numbers)}
    if apart:
        files[PARTS] = _written(apart, style, numbers)
    return Texts(files, style.gaps == 1)


class _Style:
    """How somebody writes."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.end = rng.choice(["\n", "\n", "\r\n"])
        self.final = rng.random() < 0.7
        self.indent = rng.choice(["  ", "  ", "\t", "", "    "])
        self.comments = rng.choice([0.0, 0.1, 0.4])
        self.gaps = rng.choice([0.0, 0.5, 1.0])


def _written(blocks: list[list[str]], style: _Style, numbers: "count[int]") -> str:
    lines: list[str] = []
    for header, *facts in blocks:
        lines += [""] * (style.rng.random() < style.gaps)
        lines += [_comment(style, numbers) for _ in range(2) if style.rng.random() < style.comments]
        lines.append(_trailed(header, style, numbers))
        for fact in facts:
            if style.rng.random() < style.comments / 2:
                lines.append(style.indent + _comment(style, numbers))
            lines.append(_trailed(style.indent + fact, style, numbers))
    lines += [_comment(style, numbers) for _ in range(2) if style.rng.random() < style.comments]
    return style.end.join(lines) + style.end * style.final


def _trailed(line: str, style: _Style, numbers: "count[int]") -> str:
    spaced = line.replace(" is ", "  is ") if style.rng.random() < 0.1 else line
    return f"{spaced}  {_comment(style, numbers)}" if style.rng.random() < style.comments else spaced


def _comment(style: _Style, numbers: "count[int]") -> str:
    return f"# {next(numbers)}: {style.rng.choice(WORDS)}"


def _declarations(rng: Random) -> list[list[str]]:
    skills = rng.sample(SKILLS, rng.randint(1, 6))
    functions = {skill: rng.choice([*FUNCTIONS, "rule", "rule"]) for skill in skills}
    body, drives = rng.choice([*ROBOTS[:2], *ROBOTS])
    choices = [*drives.values(), *SERVOS.values(), CLAW, MAST, *SENSORS.values()]
    parts = [*(rng.choice(lines) for lines in choices), body]
    blocks = [[_more(rng, line.split()[0], line)] for line in parts]
    blocks += [_skill(rng, skill, functions[skill], skills[place + 1 :]) for place, skill in enumerate(skills)]
    kept = [block[0].split()[1] for block in blocks if any(fact.startswith("maintains ") for fact in block[1:])]
    blocks += [[f"sensor unsafe is broken {rng.choice(kept)}"]] if kept else []
    tasks = rng.sample([*SKILLS[:3], "Roam"], rng.randint(1, 2))
    blocks += [block for task in tasks for block in _in_scene(rng, _task(rng, task))]
    if rng.random() < 0.3:
        blocks = [
            ["number wide is 2"],
            *([re.sub(r" size 2(?! \d)", " size wide", line) for line in each] for each in blocks),
        ]
    if rng.random() < 0.4 and not any(block[0].startswith("scene ") for block in blocks):  # which would part them
        alone = r"( (?:eye|inside|distance|light) of )(?:nest|dock)\b"
        blocks = [[re.sub(alone, r"\1nest or dock", block[0]), *block[1:]] for block in blocks]
    learners = [skill for skill in skills if functions[skill].startswith(("mlp", "elman", "gru", "ctrnn", "neat"))]
    if learners and rng.random() < 0.4:
        blocks.append(_like(rng, next(block for block in blocks if block[0].startswith(f"skill {learners[0]} "))))
    if is_family := rng.random() < 0.3:
        above = next(block for block in blocks if block[0].startswith(f"skill {skills[0]} "))
        above += ["reads pulseN where N is 2 to 4", "influences StepK at 1/2 where K is 1 to 2"]
        blocks += [["sensor pulseN is clock period 2 s where N is 1 to 4"], ["sensor wish is order 1 to 3"]]
        next(block for block in blocks if block[0].startswith("task ")).append("ends when pulseN > 1 where N is 1 to 2")
        blocks += [["sensor wishN is reading N of wish where N is 1 to 3"]]
        blocks += [[STEPS, "reads pulseN", "reads wishN", "drives mast"]]
    if learners:
        lessons = [
            f"teaches {skill} on {rng.choice(tasks)} {rng.choice(UNTIL)} "
            f"{rng.randint(1, 9)} generations{rng.choice(['', ' from scratch'])}"
            + rng.choice(["", "", *(f" needs {each}" for each in NEEDS)])
            for skill in rng.sample(learners, rng.randint(0, len(learners)))
        ] + [f"teaches StepN on {rng.choice(tasks)} for 2 generations where N is 1 to 3"] * is_family
        learner = rng.choice(list(kinds("curriculum")))
        blocks.append(
            [_more(rng, "curriculum", f"curriculum School is {learner} population {rng.randint(8, 9)}"), *lessons]
        )
    return blocks


def _more(rng: Random, noun: str, line: str) -> str:
    """A line that says what kind something is, with some of the arguments that it does not say."""
    kind, *words = re.split(" is | in ", line)[1].split()
    if noun == "content":
        is_placed = not {"at", "along", "grid", "within"}.isdisjoint(words)
        words += ["away", "count", "size"] * is_placed  # a place has to be free
        words += ["grid", "at", "along", "or", "within", "from"]
        is_pushed = kind in ("box", "ball") and {"seeks", "flees"}.isdisjoint(words)
        words += ["seeks", "flees", "range"]  # of what there is
        words += ["speed", "thrust"] * is_pushed
    words += ["size"] * (noun == "body")  # and there is as much room for the robot
    words += ["neutral"] * (kind == "order")  # which has to be one of them
    words += ["on"]  # of which there are servos
    words += ["noise", "lost", "every", "delay"] * (" of camp" in line)  # which is reckoned
    often = 0.5 if noun in ("curriculum", "body", "actuator") else 0.2
    for argument in arguments(kinds(noun)[kind]):
        if not argument.required and argument.key not in words and rng.random() < often:
            is_drawn = argument.key == "away" or kind == "obstacle"  # of which nothing has a schedule
            words += ["away"] * (argument.key == "grid")
            line += f" {argument.key} {_said(rng, argument, is_drawn)}"
    return line


def _said(rng: Random, argument: Argument, is_drawn: bool) -> str:
    """A value of an argument that is not its default, as it is written."""
    if isinstance(argument.type, Reference):
        return rng.choice([word for word in argument.type.words if word != argument.default])
    if argument.shape == "span":
        return rng.choice(["3 to 6", "4", "2 to 5" if is_drawn else "5 to 3 by 0.5"])
    if argument.shape == "extent":
        return rng.choice(["60 40", "2 3", "7"])
    if argument.shape == "place":
        return rng.choice(["1.5 1", "2 -0.5"])
    unit, factor = rng.choice([*argument.type.units.items()])
    default = argument.default[0] if argument.shape == "list" else argument.default
    step = 5 if argument.type.high > 1 else 1 if argument.type.whole else 0.01
    value = (min(default + step, argument.type.high) if default < argument.type.high else default - step) / factor
    return f"{value:g}{'' if unit == '%' else ' '}{unit}".rstrip()


def _skill(rng: Random, name: str, function: str, below: list[str]) -> list[str]:
    reads = rng.sample(list(SENSORS), rng.randint(1, 3))
    targets = [f"influences {skill}" for skill in rng.sample(below, rng.randint(0, min(3, len(below))))]
    driven = rng.sample([*ACTUATORS, "mood"], rng.randint(0 if targets else 1, 2))
    edges = [f"drives {part}" for part in driven] + targets
    if rng.random() < 0.3:
        rng.shuffle(edges)
    said = [
        f"{edge} at {_value(rng, reads)}" if function == "rule" or (i and rng.random() < 0.3) else edge
        for i, edge in enumerate(edges)
    ]
    said = [edge + rng.choice(GATES).format(_value(rng, reads)) if rng.random() < 0.2 else edge for edge in said]
    over = [f" over {' and '.join(rng.sample(sorted(ACTUATORS), rng.randint(1, 2)))}" for _ in said]
    said = [
        re.sub(r"^influences \S+", rf"\g<0>{each}", edge) if rng.random() < 0.2 else edge
        for edge, each in zip(said, over, strict=True)
    ]
    said = [f"{edge} cuts below 5%" if edge.startswith("inf") and rng.random() < 0.2 else edge for edge in said]
    frozen = ["stays frozen"] * (rng.random() < 0.2)
    chooses = ["chooses one"] * (bool(targets) and rng.random() < 0.3)
    said += chooses + frozen + _promises(rng)
    return [f"skill {name} is {function}", *(f"reads {reading}" for reading in reads), *said]


def _promises(rng: Random) -> list[str]:
    """Some of what a skill promises, of readings that it need not read."""
    words = [word for word in ("requires", "maintains", "achieves") if rng.random() < 0.2]
    return [f"{word} {rng.choice(sorted(NARROW))} > {rng.choice(['0.5', '10%'])}" for word in words]


def _like(rng: Random, owner: list[str]) -> list[str]:
    """A skill with the weights of another, that reads and drives something else than it, or the same."""
    reads = [fact.split()[1] for fact in owner if fact.startswith("reads ")]
    mine = [reading for reading in reads if reading in NARROW]
    others = sorted(NARROW - {*reads})
    instead = zip(rng.sample(others, len(mine)), mine, strict=True)
    lines = [f"reads {other} for {reading}" for other, reading in instead if rng.random() < 0.7]
    driven = [fact.split()[1] for fact in owner if fact.startswith("drives ")]
    free = sorted({*ACTUATORS, "mood"} - {*driven})
    instead = zip(rng.sample(free, len(driven)), driven, strict=True)
    lines += [f"drives {other} for {actuator}" for other, actuator in instead if rng.random() < 0.5]
    return [f"skill {LIKE} is like {owner[0].split()[1]}", *lines]


def _value(rng: Random, reads: list[str]) -> str:
    number = rng.choice(["0.5", "1", "20%", "1/4"])
    narrow = [reading for reading in reads if reading in NARROW]
    if not narrow or rng.random() < 0.3:
        return number
    reading = rng.choice(narrow)
    return rng.choice([reading, f"1 - {reading}", f"({number} + {reading}) * {rng.choice(narrow)}", f"{reading}/2"])


def _in_scene(rng: Random, task: list[str]) -> list[list[str]]:
    """A task as it is, or with its world in a scene of its own, of which it may say something itself."""
    if rng.random() < 0.6:
        return [task]
    (header, phrase), facts = task[0].split(" in "), task[1:]
    name = f"{header.split()[1].replace('+', '')}World"
    of_world = [fact for fact in facts if fact.startswith(("contains", "starts", "varies", "fails"))]
    own = " of (crate|cat)| within nest| pit "  # of what is said elsewhere
    things = [fact for fact in of_world if not re.search(own, fact) and rng.random() < 0.7]
    scene = [f"scene {name} is {phrase}", *things]
    other = [f"scene {name}More is like {name}", *(thing for thing in things if rng.random() < 0.2)]
    is_like = rng.random() < 0.3
    mine = [f"{header} in {name}{'More' * is_like}", *(fact for fact in facts if fact not in things)]
    return [mine, scene, *([other] if is_like else [])]


def _task(rng: Random, name: str) -> list[str]:
    scene = rng.choice(SCENES)
    arena = scene != "plain"
    things = [*map(rng.choice, THINGS), *[rng.choice(ROCKS)] * (arena and rng.random() < 0.7)]
    rewards = [rng.choice(lines) for lines in rng.sample(REWARDS + [VISITS] * arena, rng.randint(1, 3))]
    facts = [
        *(f"contains {_more(rng, 'content', thing)}" for thing in things),
        *([rng.choice(STARTS)] if rng.random() < 0.3 else []),
        *(rng.choice(lines) for lines in rng.sample(SPREADS, rng.choice([0, 0, 1, 3]))),
        *rng.choice([[], [], [], *DRAWN]),
        "lasts 600 ticks",
        *(["opens fence on 2 reach of ball"] if any("fence" in each for each in things) else []),
        rng.choice(["ends on collision", "ends on exhaustion", "ends on 2 collision", "ends when charge < 5%"]),
        *rewards,
        *(["succeeds on 3 reach of ball", "rewards 5 on success"] if rng.random() < 0.3 else []),
        "counts reach of ball",
    ]
    return [f"task {name} in {scene}", *facts]


def _noun(lines: list[str]) -> str:
    return lines[0].split()[0]


def _name(lines: list[str]) -> str:
    return lines[0].split()[1]
