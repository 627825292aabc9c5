"""A mind computed the slow and obvious way, one float32 at a time: what the engine is held against."""

import math
import operator

import numpy as np
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.memory import Cell, Counter, Place, Register
from mindrun.kinds.sensors.compass import Compass, Direction
from mindrun.kinds.sensors.computed import Broken, Computed
from mindrun.kinds.sensors.derived import Average, Derivative, Mirrored, Reading, Turned
from mindrun.kinds.sensors.nearest import Bearing, Distance
from mindrun.kinds.sensors.waves import Clock, Sine
from mindrun.numbers.arithmetic import DENOMINATOR, LIMIT, NUMERATOR, bearing
from mindrun.numbers.network import Terms, matrices
from mindrun.numbers.trigonometry import cosine, sine

from tests.hierarchies import PROCEDURES

f = np.float32
COMPARES = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}


class Plain:
    """One mind and its state."""

    def __init__(self, graph, weights, master=None):
        self.graph, self.weights, self.master = graph, weights, master or graph.master
        self.t, self.before, self.faults = 0, None, 0
        self.kept = [[f(memory.kind.start)] * memory.kind.kept for memory in graph.memories]
        self.past = {}  # by virtual sensor and reading
        self.said, self.modules = {}, {}  # by skill: of a network that remembers, and of a procedure

    def tick(self, readings):
        """The commands for the readings of one tick."""
        with np.errstate(all="ignore"):
            self.readings = [f(r) for r in readings]
            self.fill()
            self.spread()
            self.before, self.t = self.readings, self.t + 1
            means = self.means("memory")
            for i, memory in enumerate(self.graph.memories):
                self.kept[i] = self.keep(memory.kind, self.kept[i], means[i])
            means = self.means("actuator")
            neutral = [f(actuator.kind.neutral) for actuator in self.graph.actuators]
            return [n if m is None else m for m, n in zip(means, neutral, strict=True)]

    def keep(self, kind, kept, command):
        """What a memory keeps after a tick, under a command or None."""
        match kind:
            case Cell():
                faded = f(kind.decay) * kept[0]
                return [faded if command is None else faded + f(1 - kind.decay) * command]
            case Register():
                return kept if command is None else [command]
            case Counter():
                rises = command is not None and command > 0.5
                count = min(f(1), kept[0] + f(kind.step)) if rises and not kept[1] else kept[0]
                return [f(0) if command is not None and command < 0.25 else count, f(rises)]
            case Place():
                left, right, compass = (self.sensor(name) for name in (kind.left, kind.right, kind.compass))
                ways = [s.kind.range * self.graph.tick / (2 * kind.range) for s in (left, right)]
                pairs = zip((left, right), ways, strict=True)
                way = sum((self.readings[s.start] - np.float64(0.5)) * w for s, w in pairs)
                angle = 2.0 * np.pi * (np.float64(self.readings[compass.start]) - 0.25)
                is_here, found = command is not None and command > 0.5, []
                shares = (cosine(angle), sine(angle)) if math.isfinite(angle) else (np.nan, np.nan)
                for number, share in zip(kept, shares, strict=True):
                    step = way * share
                    step = step if abs(step) <= 1 else 0.0
                    found.append(clamp(f(np.float64(f(0.5) if is_here else number) - step)))
                return found

    def sensor(self, name):
        """The sensor of a name."""
        return next(sensor for sensor in self.graph.sensors if sensor.name == name)

    def reckoned(self, kind, place):
        """A reading of a bearing or a distance of a place."""
        east, north = self.readings[place.start : place.start + 2]
        far = np.sqrt((np.float64(east) - 0.5) ** 2 + (np.float64(north) - 0.5) ** 2) * f(2 * place.kind.range)
        if isinstance(kind, Distance):
            return clamp(f(far / kind.range))
        compass = self.readings[self.sensor(place.kind.compass).start]
        if not math.isfinite(compass):
            return f(np.nan) if not kind.range or far <= kind.range else f(0.5)
        angle = 2.0 * np.pi * (np.float64(compass) - 0.25)
        c, s, x, y = f(cosine(angle)), f(sine(angle)), east - f(0.5), north - f(0.5)
        v = bearing(c * x + s * y, c * y - s * x)
        return v if abs(v - f(0.5)) >= f(kind.dead_zone) and (not kind.range or far <= kind.range) else f(0.5)

    def fill(self):
        """Set the readings of memories and virtual sensors."""
        for memory, kept in zip(self.graph.memories, self.kept, strict=True):
            self.readings[memory.place] = kept
        done = {s.name for s in self.graph.sensors if not (s.kind.sources or isinstance(s.kind, Computed | Broken))}
        done |= {memory.name for memory in self.graph.memories}
        waiting = [s for s in self.graph.sensors if s.name not in done]
        for sensor in self.graph.sensors:
            if isinstance(sensor.kind, Sine):
                turns = self.t / (sensor.kind.period / self.graph.tick)
                self.readings[sensor.start] = f(0.5 + 0.5 * sine(2 * math.pi * (turns - math.floor(turns))))
            if isinstance(sensor.kind, Clock):
                turns = self.t / (sensor.kind.period / self.graph.tick)
                self.readings[sensor.start] = f(turns - math.floor(turns))
        while waiting:
            sensor = next(s for s in waiting if done.issuperset(s.kind.sources))
            waiting.remove(sensor)
            done.add(sensor.name)
            for i in range(sensor.width):
                self.readings[sensor.start + i] = self.virtual(sensor, i)

    def virtual(self, sensor, i):
        """One reading of a sensor that is computed from others."""
        kind, parts = sensor.kind, {part.name: part for part in (*self.graph.sensors, *self.graph.memories)}
        if isinstance(kind, Computed):
            program = [(word, parts[x].start if word == "reading" else x) for word, x in kind.at]
            value = f(postfix(program, self.readings))
            if math.isfinite(value) and not 0 <= value <= 1 and is_turned(kind.at, parts):
                value = value - np.floor(value)
            return clamp(value) if math.isfinite(value) else f(np.nan)
        if isinstance(kind, Broken):
            number = [skill.name for skill in self.graph.skills].index(kind.broken)
            program = [(word, parts[x].start if word == "reading" else x) for word, x in kind.maintains]
            holds = postfix(program, self.readings)
            return f(0 if self.t == 0 or not self.influence[number] > 0 or holds > 0 else 1 if holds == 0 else np.nan)
        source = parts[kind.of]
        if isinstance(kind, Bearing | Distance):
            return self.reckoned(kind, source)
        match kind:
            case Derivative():
                return self.derivative(kind, source, i, turns(source, parts))
            case Turned():
                way = np.float64(self.readings[source.start + i]) - np.float64(f(kind.by / (2 * math.pi)))
                return f(way if 0 <= way <= 1 else way - math.floor(way) if math.isfinite(way) else way)
            case Mirrored():
                other = self.readings[source.start + sensor.width - 1 - i]
                return f(1) - other if turns(source, parts) else other
            case Reading():
                return self.readings[source.start + kind.reading - 1]
        past = self.past.setdefault((sensor.name, i), [])
        past.append(self.readings[source.start + i])
        if isinstance(kind, Average):
            return self.average(past, kind.over, turns(source, parts))
        state = f(0)
        for reading in past:
            state = f(1) if reading < f(kind.below) else state
            state = f(0) if reading > f(kind.above) else state
        return state if math.isfinite(past[-1]) else f(np.nan)

    @staticmethod
    def average(past, over, turns):
        """The mean of the last readings, in the order of their places in a ring; of the short ways from the newest."""
        newest = len(past) - 1
        last = sorted(range(max(0, newest - over + 1), newest + 1), key=lambda tick: tick % over)
        total = np.float64(0)
        for tick in last:
            way = np.float64(past[tick]) - np.float64(past[newest])
            total = total + (way - np.rint(way) if turns else np.float64(past[tick]))
        mean = total / len(last)
        if turns:
            mean = np.float64(past[newest]) + mean
            mean = mean + 1 if mean < 0 else mean - 1 if mean > 1 else mean
        return f(mean)

    def derivative(self, kind, source, i, turns):
        """One reading of a derivative."""
        if self.before is None:
            return f(0.5)
        now, before = self.readings[source.start + i], self.before[source.start + i]
        if not (math.isfinite(now) and math.isfinite(before)):
            return f(np.nan)
        d = now - before
        d = d - np.rint(d) if turns else d
        v = clamp(f(0.5) + d * f(0.5 / (self.graph.tick * kind.range)))
        return f(0.5) if abs(v - f(0.5)) < f(kind.dead_zone) else v

    def spread(self):
        """Equation 2 and the sums of Equation 3."""
        reached = {self.master}
        for skill in self.graph.skills:  # parents first
            if skill.name in reached:
                reached |= {self.graph.skills[edge.target].name for edge in skill.edges if edge.to == "skill"}
        self.influence = [f(s.name == self.master) if s.name in reached else f(np.nan) for s in self.graph.skills]
        self.com = {"actuator": [f(0)] * len(self.graph.actuators), "memory": [f(0)] * len(self.graph.memories)}
        self.total = {noun: list(zeros) for noun, zeros in self.com.items()}
        heard = {(to, i): list(self.influence) for to, sinks in self.com.items() for i in range(len(sinks))}
        for place, skill in enumerate(self.graph.skills):
            own = self.influence[place]
            if own == 0 or skill.name not in reached:
                continue
            inputs = [self.readings[i] for i in skill.inputs]
            if not all(map(math.isfinite, inputs)):
                self.faults += len(skill.edges)
                continue
            outputs = self.outputs(skill, inputs)
            values = [self.value(edge, outputs) for edge in skill.edges]
            choice = self.choice(skill, values)
            for number, (edge, value) in enumerate(zip(skill.edges, values, strict=True)):
                if value is not None and math.isfinite(value) and skill.chooses and edge.to == "skill":
                    value = f(number == choice)
                if value is None:
                    continue
                if not math.isfinite(value):
                    self.faults += 1
                elif edge.to == "skill":
                    if not clamp(value) * own < f(edge.cuts):
                        self.influence[edge.target] += clamp(value) * own
                    for sink, influence in heard.items():
                        sent = clamp(value) * influence[place]
                        if (not edge.over or sink in edge.over) and not sent < f(edge.cuts):
                            influence[edge.target] += sent
                else:
                    own_there = heard[edge.to, edge.target][place]
                    self.com[edge.to][edge.target] += clamp(value) * own_there
                    self.total[edge.to][edge.target] += own_there

    @staticmethod
    def choice(skill, values):
        """The first of the greatest influences, by its number."""
        there = [
            (value, -number)
            for number, (edge, value) in enumerate(zip(skill.edges, values, strict=True))
            if edge.to == "skill" and value is not None and math.isfinite(value)
        ]
        return -max(there)[1] if there else None

    def value(self, edge, outputs):
        """What an edge sends; None where its gate is closed."""
        if edge.gate:
            holds = postfix(edge.gate.when, self.readings)
            if math.isnan(holds):
                return f(np.nan)
            if not holds:
                return None if edge.gate.otherwise is None else f(postfix(edge.gate.otherwise, self.readings))
        return outputs[edge.output] if edge.output is not None else f(postfix(edge.value, self.readings))

    def means(self, noun):
        """Equation 3 for the actuators or the memories; None where nothing drives, or the sums overflowed: a fault."""
        found = []
        for com, total in zip(self.com[noun], self.total[noun], strict=True):
            sound = math.isfinite(com / total)
            self.faults += total != 0 and not sound
            found.append(clamp(com / total) if total != 0 and sound else None)
        return found

    def outputs(self, skill, inputs):
        """The internal function's outputs."""
        if not skill.outputs:
            return []
        match skill.function:
            case Procedure(from_=name):
                return self.called(skill, name.split("."), inputs)
            case function if not inputs or not function.learns:
                return [f(0)] * skill.outputs
            case function:
                shapes = function.matrix_shapes(len(inputs), skill.outputs)
                state = self.said.get(skill.name, np.zeros(function.state_length(len(inputs), skill.outputs), f))
                found = matrices(self.weights[skill.owner], shapes)
                outputs, self.said[skill.name] = function.forward(PLAIN, found, np.array(inputs, f), state)
                return [*outputs]

    def called(self, skill, name, inputs):
        """What a procedure returns, of a module that only this skill calls."""
        module, function = name
        if skill.name not in self.modules:
            self.modules[skill.name] = {}
            exec((PROCEDURES / f"{module}.py").read_text(), self.modules[skill.name])
        found = self.modules[skill.name][function](*map(float, inputs))
        return [f(value) for value in (found if isinstance(found, list | tuple) else [found])]


def turns(part, parts):
    """Whether a sensor or memory reads a direction."""
    match part.kind:
        case Average(of=of) | Reading(of=of) | Turned(of=of) | Mirrored(of=of):
            return turns(parts[of], parts)
        case Computed(at=formula):
            return is_turned(formula, parts)
    return isinstance(part.kind, Bearing | Compass | Direction)


def is_turned(formula, parts):
    """Whether a formula is one direction, added or taken away once, more or less numbers."""
    stack = []  # how often each part has a direction, NaN where that is nothing of the kind
    for word, operand in formula:
        if word == "number":
            stack.append(0)
        elif word == "reading":
            stack.append(1 if turns(parts[operand], parts) else math.nan)
        elif word == "negate":
            stack.append(-stack.pop())
        else:
            b, a = stack.pop(), stack.pop()
            if word == "when" or (word == "otherwise" and abs(a) == abs(b)):
                stack.append(a)
                continue
            stack.append(a + b if word == "+" else a - b if word == "-" else 0 if a == b == 0 else math.nan)
    return abs(stack[0]) == 1


def dense(weights, values):
    """A neuron's sum, strictly from left to right."""
    total = weights[0] * values[0]
    for w, x in zip(weights[1:], values[1:], strict=True):
        total = total + w * x
    return total


def sigmoid(x):
    """The sigmoid as it is defined."""
    h, limit = f(0.5), f(LIMIT)
    x = x * h
    x = x if x > -limit else -limit
    x = x if x < limit else limit
    y = x * x
    p, q = f(NUMERATOR[-1]), f(DENOMINATOR[-1])
    for a in NUMERATOR[-2::-1]:
        p = p * y + f(a)
    for b in DENOMINATOR[-2::-1]:
        q = q * y + f(b)
    return h + h * (p * x / q)


PLAIN = Terms(  # in which a function says what it computes
    product=lambda values, matrix: np.array([dense(row, values) for row in matrix], f),
    sigmoid=lambda values: np.array([sigmoid(value) for value in values], f),
    joined=lambda one, other: np.array([*one, *other], f),
    biased=lambda values: np.array([1, *values], f),
)


def clamp(v):
    """Into 0..1."""
    v = v if v > 0 else f(0)
    return v if v < 1 else f(1)


def postfix(program, readings):
    """An expression's value in float64."""
    stack = []
    for word, operand in program:
        if word in ("number", "reading"):
            stack.append(np.float64(operand if word == "number" else readings[operand]))
        elif word == "negate":
            stack.append(-stack.pop())
        else:
            b, a = stack.pop(), stack.pop()
            if word == "when":  # None where the condition does not hold
                stack.append(None if b == 0 else a if b == 1 else np.float64(np.nan))
                continue
            if word == "otherwise":
                stack.append(b if a is None else a)
                continue
            if word not in "+-*/" and (math.isnan(a) or math.isnan(b)):
                stack.append(np.float64(np.nan))
                continue
            match word:
                case "least" | "and":
                    stack.append(b if b < a else a)
                case "greatest" | "or":
                    stack.append(b if b > a else a)
                case "<" | "<=" | ">" | ">=":
                    stack.append(np.float64(COMPARES[word](a, b)))
                case "+":
                    stack.append(a + b)
                case "-":
                    stack.append(a - b)
                case "*":
                    stack.append(a * b)
                case "/":
                    stack.append(a / b)
    return stack.pop()
