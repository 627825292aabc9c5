"""Common malformed lines and what to say of them; each has an example, which the tests hold it to."""

from dataclasses import dataclass

from mindlang.syntax import PARTS, VERBS, WHOLES


@dataclass(frozen=True, slots=True)
class Mistake:
    """A malformed line: the first pattern found explains it. `here` is what to point at; `example` is one such line."""

    code: str
    pattern: str
    message: str
    hint: str
    example: str


_PART, _WHOLE, _VERB = ("|".join(words) for words in (PARTS, WHOLES, VERBS))

MISTAKES = (
    Mistake(
        "odd-space",
        r"(?P<here>[^\S \t])",
        "This is not an ordinary space.",
        "Replace it by a space; it often comes along when text is copied from a page.",
        "reads\u00a0moving",
    ),
    Mistake(
        "quoted-path",
        r"""^\s*use\s+(?P<here>[^"\s].*|'.*)$""",
        "The path of a file stands in quotes.",
        'Write use "file.mind".',
        "use other.mind",
    ),
    Mistake(
        "comma",
        r"(?P<here>[,;])",
        "A list has no commas or semicolons.",
        "Separate values by spaces.",
        "sensor eyes is range_finder at 0, 90 deg",
    ),
    Mistake(
        "comparison",
        r"(?P<here>==|!=|=<|=>|≤|≥|<>)",
        "{here} is not a comparison of the language.",
        "Compare with < <= > or >=; readings are real numbers, which are hardly ever equal.",
        "rewards 1 per tick when holding == 1",
    ),
    Mistake(
        "equals-sign",
        r"(?P<here>(?<![<>])=)",
        "An argument has no equals sign.",
        "Write size 4, not size = 4.",
        "body Robot is disc size=2",
    ),
    Mistake(
        "power",
        r"(?P<here>\*\*|\^)",
        "There are no powers, only + - * and /.",
        "Multiply: x * x.",
        "rewards p ** 2 per tick",
    ),
    Mistake("colon", r"(?P<here>:)", "A line has no colon.", "Leave it out.", "skill Avoid is mlp hidden 2:"),
    Mistake(
        "braces",
        r"(?P<here>[][{}])",
        "The language has no braces and no brackets.",
        "One fact stands on each line; a list is written with spaces between its values.",
        "sensor eyes is range_finder at [0 90] deg",
    ),
    Mistake(
        "quotes",
        r"""^\s*(?!use\b).*?(?P<here>["'`]+)""",
        "Names stand without quotes.",
        "Leave the quotes out.",
        "reads 'moving'",
    ),
    Mistake(
        "odd-character",
        r"(?P<here>[^\w\s.%()+*/<>=\"-])",
        "The character {here} is no part of the language.",
        "Remove it.",
        "reads moving!",
    ),
    Mistake(
        "small-name",
        rf"^\s*(?P<noun>{_PART})\s+(?P<here>[A-Z][\w+]*)",
        "The name of {a_noun} begins with a small letter.",
        "Write {snake}.",
        "sensor ObjectBearing is bearing of object",
    ),
    Mistake(
        "capital-name",
        rf"^\s*(?P<noun>{_WHOLE}|task)\s+(?P<here>[a-z][\w]*)\s+(?:is|in)\b",
        "The name of {a_noun} begins with a capital letter.",
        "Write {title}.",
        "skill avoid is mlp",
    ),
    Mistake(
        "small-name",
        r"^\s*(?P<noun>reads|drives|contains)\s+(?P<here>[A-Z][\w+]*)",
        "What a line {noun} has a name that begins with a small letter.",
        "Did you mean {snake}?",
        "reads Moving",
    ),
    Mistake(
        "capital-name",
        r"^\s*(?P<noun>influences|teaches|master)\s+(?P<here>[a-z]\w*)",
        "The name of a skill begins with a capital letter.",
        "Did you mean {title}?",
        "influences avoid",
    ),
    Mistake(
        "task-in",
        r"^\s*task\s+[A-Z][\w+]*\s+(?P<here>is)\b",
        "A task is in a scene.",
        "Write in instead of is: task Avoid in arena size 100.",
        "task Avoid is arena",
    ),
    Mistake(
        "missing-in",
        r"^\s*task\s+(?P<here>[A-Z][\w+]*)(?!\s*\+|\s+in\b)\b",
        "After the name of a task comes in and its scene.",
        "Write task {here} in arena size 100, or in plain.",
        "task Avoid arena",
    ),
    Mistake(
        "missing-is",
        rf"^\s*(?P<noun>{_PART}|{_WHOLE})\s+(?P<here>[\w+.]+)\b(?![+.]|\s+is\b)",
        "After the name of {a_noun} comes is and its kind.",
        "Write {noun} {here} is KIND.",
        "skill Avoid mlp hidden 2",
    ),
    Mistake(
        "missing-is",
        r"^\s*contains\s+(?P<here>[\w.]+)\b(?!\.|\s+is\b)",
        "After the name of a thing comes is and its kind.",
        "Write contains {here} is item, zone, obstacle or power.",
        "contains rock obstacle",
    ),
    Mistake(
        "missing-on",
        r"^\s*(?P<here>ends)\b(?!\s+on\b)",
        "A task ends on an event.",
        "Write ends on collision.",
        "ends collision",
    ),
    Mistake(
        "missing-for",
        r"^\s*teaches\s+(?P<here>[A-Z][\w+]*\s+on\s+[A-Z][\w+]*)(?!.*\bfor\b)",
        "A lesson says for how long.",
        "Write teaches {here} for 1000 generations.",
        "teaches Avoid on Avoid",
    ),
    Mistake(
        "missing-task",
        r"^\s*teaches\s+(?P<here>[A-Z][\w+]*)\b(?!\+|\s+on\b)",
        "A lesson says on which task.",
        "Write teaches {here} on TASK for 1000 generations.",
        "teaches Avoid for 100 generations",
    ),
    Mistake(
        "unknown-unit",
        r"\d\s*(?P<here>(?:sec|secs|second|seconds|ms|min|minutes|hz|degree|degrees|rad|percent|tick|generation)\b|°)",
        "{here} is not a unit of the language.",
        "The units are s, ticks, generations, deg and %.",
        "sensor pulse is sine period 2 seconds",
    ),
    Mistake(
        "two-facts",
        rf"^\s*\w+\s.*?(?<=\s)(?P<here>{_VERB})(?=\s)",
        "Two facts stand on one line.",
        "Begin a new line before {here}.",
        "reads moving drives left_wheel",
    ),
    Mistake(
        "when-given",
        r"^\s*rewards\s+(?P<here>(?:(?!\s+(?:per|on)\b).)+)$",
        "A reward says when it is given.",
        "Add per tick, or on and an event.",
        "rewards 0.01 * forward",
    ),
    Mistake(
        "parenthesis",
        r"(?P<here>\()(?:[^()]|\([^()]*\))*$",
        "A parenthesis is not closed.",
        "Add ).",
        "drives claw at (holding + 1",
    ),
)
