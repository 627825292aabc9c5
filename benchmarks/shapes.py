"""Files of any length in the shapes that make a compiler slow: each noun and each mistake said over and over.

`SHAPES[name](lines)` is the text of a file of about so many lines (or of a line with so many words).
"""

from collections.abc import Callable, Mapping

HEAD = """\
tick 1/60 s
master Go
body Robot is disc
actuator left is wheel side left neutral 0.5
sensor eye is battery
memory mood is cell decay 0.9
"""
GO = """\
skill Go is rule
  reads eye
  drives left at eye
"""
LEARNS = """\
skill Go is mlp
  reads eye
  drives left
"""
TASK = """\
task Go in arena
  contains ball is item
  lasts 9 s
  rewards forward per tick
"""

Shape = Callable[[int], str]


def _body(line: str, of: str, tail: str = "") -> Shape:
    """A shape with one line over and over; {n} is its number, {m} that of the line before."""
    return lambda lines: of + "".join(line.format(n=n, m=n - 1) + "\n" for n in range(lines)) + tail


def _spread(lines_of: str, of: str, per: int) -> Shape:
    """A shape with several lines over and over."""
    return lambda lines: of + "".join(lines_of.format(n=n, m=n - 1) for n in range(lines // per))


def _wide(lines: int) -> str:
    """Wide sensors that many skills read."""
    angles = " ".join(["0"] * 30)
    sensors = [f"sensor eye{n} is range_finder at {angles} deg" for n in range(30)]
    skills = [f"skill S{n} is mlp\n  reads eye{n % 30}\n  drives left" for n in range(lines // 4)]
    edges = [f"  influences S{n}" for n in range(lines // 4)]
    return "\n".join([HEAD + GO.strip(), *edges, *sensors, *skills]).replace("Go is rule", "Go is mlp") + "\n"


def _layers(lines: int) -> str:
    """A hierarchy of layers of three skills, each of which influences all three below it."""
    text = [HEAD, "skill Go is rule\n  influences S0x0 at 1\n  influences S0x1 at 1\n  influences S0x2 at 1\n"]
    layers = max(2, lines // 12)
    for layer in range(layers):
        below = "".join(f"  influences S{layer + 1}x{n} at eye\n" for n in range(3) if layer + 1 < layers)
        said = below or "  drives left at eye\n"
        text += [f"skill S{layer}x{n} is rule\n  reads eye\n{said}" for n in range(3)]
    return "".join(text)


def _chain(kind: str, at: str) -> Shape:
    """Skills each of which influences the next."""

    def text(lines: int) -> str:
        skills = max(2, lines // 4)
        head = f"skill Go is {kind}\n  reads eye\n  influences S0{at}\n"
        ends = f"skill S{skills - 1} is {kind}\n  reads eye\n  drives left{at}\n"
        below = (f"skill S{n} is {kind}\n  reads eye\n  influences S{n + 1}{at}\n" for n in range(skills - 1))
        return HEAD + head + "".join(below) + ends

    return text


def _line(begin: str, words: str, end: str = "\n", before: str = HEAD, after: str = "") -> Shape:
    """A shape with one long line."""
    return lambda lines: before + begin + "".join(words.format(n=n) for n in range(lines)) + end + after


RIGHT: Mapping[str, Shape] = {
    "sensors": _body("sensor s{n} is battery", HEAD + GO),
    "actuators": _body("actuator a{n} is wheel side left neutral 0.5", HEAD + GO),
    "memories": _body("memory m{n} is cell", HEAD + GO),
    "derivatives": lambda lines: HEAD + GO + "sensor d0 is battery\n" + "".join(
        f"sensor d{n} is derivative of d{n - 1}\n" for n in range(1, lines)),
    "skills that nobody reaches": _spread("skill S{n} is rule\n  drives left at 1\n", HEAD + GO, 2),
    "skills that learn": _spread("skill S{n} is mlp\n  reads eye\n  drives left\n", HEAD + GO, 3),
    "edges of one skill": lambda lines: HEAD + GO + "".join(
        f"  influences S{n} at 1\n" for n in range(lines // 3)) + "".join(
        f"skill S{n} is rule\n  drives left at 1\n" for n in range(lines // 3)),
    "chain of rules": _chain("rule", " at eye"),
    "chain of networks": _chain("mlp", ""),
    "layers": _layers,
    "wide sensors": _wide,
    "reads of one skill": lambda lines: HEAD + "".join(f"sensor s{n} is battery\n" for n in range(lines // 2))
    + LEARNS + "".join(f"  reads s{n}\n" for n in range(lines // 2)),
    "tasks": _spread("task T{n} in plain\n  lasts 9 s\n", HEAD + GO, 2),
    "things of one task": _body("  contains b{n} is item", HEAD + GO + TASK),
    "rewards of one task": _body("  rewards {n} * eye per tick when eye > 0.5", HEAD + GO + TASK),
    "events of one task": _body("  ends on reach of ball over {n}", HEAD + GO + TASK),
    "counts of one task": _body("  counts collision", HEAD + GO + TASK),
    "lessons of one curriculum": _body("  teaches Go on Go for 1{n} generations", HEAD + LEARNS + TASK
                                       + "curriculum C is genetic\n  teaches Go on Go for 9 generations\n"),
    "lessons of many skills": lambda lines: HEAD + LEARNS + TASK + "".join(
        f"skill S{n} is mlp\n  reads eye\n  drives left\n" for n in range(lines // 4))
    + "curriculum C is genetic\n" + "".join(f"  teaches S{n} on Go for 9 generations\n" for n in range(lines // 4)),
    "curricula": _spread("curriculum C{n} is genetic\n  teaches Go on Go for 9 generations\n", HEAD + LEARNS + TASK, 2),
    "comments": _body("# {n}", HEAD + GO),
    "comments and facts": _spread("# {n}\nsensor s{n} is battery # why\n", HEAD + GO, 2),
    "comments in a skill": _body("  # {n}", HEAD + GO),
    "blank lines": _body("", HEAD + GO),
    "blanks": _body("      ", HEAD + GO),
    "similar names": _body("sensor s_{n}_ is battery", HEAD + GO),
    "one long comment": _line("# ", "word{n} "),
    "one long sum": _line("  drives left at 0", " + eye", before=HEAD + "skill Go is rule\n  reads eye\n"),
    "one long list": _line("sensor wide is range_finder at", " 1", " deg\n", after=GO),
    "carriage returns": _body("sensor s{n} is battery\r", HEAD + GO),
}  # fmt: skip

WRONG: Mapping[str, Shape] = {
    "one sensor again": _body("sensor eye is battery", HEAD + GO),
    "one skill again": _spread("skill Go is rule\n  drives left at 1\n", HEAD, 2),
    "things in one place": _body("  contains b{n} is item at 1 1", HEAD + GO + TASK),
    "one task again": _spread("task T in plain\n  lasts 9 s\n", HEAD + GO, 2),
    "one thing again": _body("  contains ball is item", HEAD + GO + TASK),
    "one reading again": _body("  reads eye", HEAD + GO),
    "one edge again": _body("  drives left at 1", HEAD + GO),
    "bodies": _body("body B{n} is disc", HEAD + GO),
    "masters": _body("master Go", HEAD + GO),
    "ticks": _body("tick 1/{n}9 s", HEAD + GO),
    "endings": _body("  lasts 9 s", HEAD + GO + TASK),
    "misspelt readings": _spread("sensor sensor_{n} is battery\n  reads sensr_{n}\n", HEAD + GO, 2),
    "readings not there": lambda lines: HEAD + "".join(f"sensor s{n} is battery\n" for n in range(lines // 2))
    + LEARNS + "".join(f"  reads x{n}\n" for n in range(lines // 2)),
    "misspelt skills": _body("  influences Skil{n}", HEAD + GO),
    "misspelt things": _body("  rewards 1 on reach of bal{n}", HEAD + GO + TASK),
    "things not there": lambda lines: HEAD + GO + TASK + "".join(
        f"  contains b{n} is item\n" for n in range(lines // 2)) + "".join(
        f"  rewards 1 on reach of x{n}\n" for n in range(lines // 2)),
    "unknown kinds": _body("sensor s{n} is lidar", HEAD + GO),
    "unknown arguments": _body("sensor s{n} is battery siz {n}", HEAD + GO),
    "arguments again": _line("sensor s is battery", " drain 0", after=GO),
    "wrong units": _body("sensor s{n} is range_finder at 1 s", HEAD + GO),
    "foreign facts": _body("  reads eye", HEAD + GO + TASK),
    "facts below a sensor": _body("  reads eye", HEAD + GO + "sensor s is battery\n"),
    "loop of skills": lambda lines: _chain("rule", " at eye")(lines) + "  influences Go at 1\n",
    "loop of derivatives": lambda lines: HEAD + GO + "".join(
        f"sensor d{n} is derivative of d{(n + 1) % lines}\n" for n in range(lines)),
    "unreadable lines": _body("skill S{n} has 3 + sensors", HEAD + GO),
    "unreadable words": _body("reed eye{n}", HEAD + GO),
    "missing files": _body('use "f{n}.mind"', HEAD + GO),
    "one long name": _line("sensor ", "a", " is battery\n", after=GO),
    "one long number": _line("tick ", "9", " s\n", before="", after=GO),
    "one long unreadable line": _line("", "word{n} "),
    "one long line of parentheses": _line("  drives left at ", "(eye)", before=HEAD + GO),
    "one long line of quotes": _line("use ", '"a" ', before=HEAD + GO),
    "one long wrong sum": _line("  drives left at 0", " + eys{n}", before=HEAD + "skill Go is rule\n  reads eye\n"),
    "divisions by zero": _line("  drives left at 0", " + eye / 0", before=HEAD + "skill Go is rule\n  reads eye\n"),
    "letters that are none": _line("", "é"),
    "nulls": _line("", "\0 "),
}  # fmt: skip

SHAPES: Mapping[str, Shape] = {**RIGHT, **WRONG}
