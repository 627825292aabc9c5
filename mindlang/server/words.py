"""What the words of the language are for, in a line each."""

NOUNS = {
    "body": "The robot's body; a mind has one.",
    "actuator": "What the robot acts with; `neutral` is sent when nothing influences it.",
    "sensor": "What the robot senses: one or more readings in 0..1.",
    "memory": "A number that is driven like an actuator, and read like a sensor on the next tick.",
    "skill": "A behaviour: it reads sensors, drives actuators and influences other skills.",
    "scene": "A world that tasks share: `scene NAME is arena`, and `task NAME in SCENE`.",
    "task": "A world to learn in, with its end and its rewards: `task NAME in SCENE`.",
    "curriculum": "Lessons in their order, and the way in which they are learnt.",
}
SETTINGS = {
    "tick": "How long a tick is: `tick 1/60 s`.",
    "master": "The skill that is in charge: it receives the influence 1.",
    "use": 'The declarations of another file: `use "collect.mind"`; with `as walls` its names begin with `walls.`.',
    "number": "A name for a number, which may stand wherever a quantity may: `number sight is 12`.",
    "unit": "How long a unit of the world is on a robot: `unit 8.5 cm`.",
    "mind": "For which version of the language the file was written: `mind 1`.",
}
VERBS = {
    "reads": "An input: a sensor, with all of its readings, or a memory.",
    "drives": "An output that commands an actuator or a memory; with `at`, the value of an expression.",
    "influences": "An output that says how much another skill acts; with `at`, the value of an expression; "
    "with `when`, only where that holds; with `cuts below`, none where it is smaller.",
    "stays": "`stays frozen`: the skill refuses training.",
    "contains": "A thing in the world of the task, placed at random: `contains object is item size 1`.",
    "starts": "Where the robot starts: `starts at 0 0 facing 90 deg`.",
    "varies": "An argument that is drawn anew for each run: `varies thrust of left_wheel 60 to 90`.",
    "fails": "What may break, and how soon: stuck at neutral from then on: `fails left_wheel 1% per s`.",
    "lasts": "After how long the task ends: `lasts 10000 ticks`, `lasts 60 s`.",
    "ends": "What ends the task early: `ends on collision`, `ends when battery < 5%`.",
    "succeeds": "What ends the task as a success: `succeeds on 5 delivery of red`.",
    "rewards": "What a tick, or an event, is worth: `rewards EXPRESSION per tick`, `rewards EXPRESSION on EVENT`.",
    "counts": "An event that `mindc bench` counts.",
    "teaches": "A lesson: `teaches SKILL on TASK for 100 generations`.",
}
JOINTS = {
    "is": "After it comes the kind.",
    "is like": "The same as another: a skill shares its weights, a task or scene says what it says, and more.",
    "as": "What stands before the names of the used file.",
    "in": "After it comes the scene of a task, or the sensor that `for each` goes through.",
    "at": "The value of the edge, instead of an output of the skill's function; clamped to 0..1.",
    "on": "After it comes an event or, in a lesson, the task.",
    "under": "The skill that is in charge while another learns; by default the learner itself.",
    "for": "For how long a lesson goes on; in a skill that is like another, the input that is replaced; "
    "`for each p in SENSOR` goes through the readings of a sensor.",
    "per tick": "The reward is added in every tick.",
    "for each": "The reward is added for each reading of a sensor: `for each p in proximity`.",
    "when": "Only where this holds: `when holding < 0.5 and near > 0.2`.",
    "otherwise": "What is sent where the condition does not hold.",
    "cuts below": "An influence smaller than this is none: `cuts below 5%`.",
    "and": "Both comparisons hold.",
    "or": "One of the comparisons holds; `and` holds more tightly.",
    "least of": "The least of several: `least of left right`.",
    "greatest of": "The greatest of several: `greatest of left right`.",
    "facing": "In which direction the robot looks when it starts.",
    "per": "The time that a rate is for: `drain 0.003 per s`.",
    "from": "The skill whose weights a lesson begins with: `from GoToObject`.",
    "from scratch": "The lesson starts from random weights, not from those that the skill has.",
    "with subskills": "All skills below that learn are taught along, as one genome.",
    "using": "After it comes the kind of learner of a lesson, where it is not the curriculum's.",
    "frozen": "The skill refuses training; lessons with subskills leave it out.",
}
UNITS = {
    "s": "seconds",
    "ticks": "ticks of the mind",
    "generations": "generations of a learner",
    "deg": "degrees",
    "cm": "centimetres",
    "mm": "millimetres",
    "m": "metres",
    "%": "hundredths",
}
WORDS = NOUNS | SETTINGS | VERBS | JOINTS | UNITS
