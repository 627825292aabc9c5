"""Think: influence flows down the hierarchy (Eq. 2) and the skills that have some compute what they send (Eq. 1)."""

from mindrun.numbers.arithmetic import *
from mindrun.numbers.stack_machine import evaluate
from mindrun.sim.codes import Tables
from mindrun.sim.kind_lanes import compute
from mindrun.sim.procedures import call_procedure
from mindrun.sim.state import FAILED_COLUMN, FAILED_SKILL, MindState, State
from mindrun.sim.units import unit, unit_where

NOT_SENT = F(-1)


def begin(tables, mind, lanes):
    """Set all influence to 0 but the master's, which is 1."""
    mind.influence[:, :lanes] = ZERO
    mind.command_sums[:, :lanes] = ZERO
    mind.influence_sums[:, :lanes] = ZERO
    robots = len(tables.robots)
    if len(mind.scoped) > 1:
        mind.scoped[:, :lanes] = ZERO
    for number in range(robots):
        master = tables.robots[number].master
        give_all(mind.influence[master], number, robots, lanes)
        for row in range(master, len(mind.scoped) if len(mind.scoped) > 1 else 0, len(mind.influence)):
            give_all(mind.scoped[row], number, robots, lanes)


def give_all(influence, first, step, lanes):
    """Let influence be 1 in each `step`th lane from the first one on."""
    if step == 1:
        influence[:lanes] = ONE
    for lane in range(first, lanes if step > 1 else 0, step):
        influence[lane] = ONE


@unit
def think(tables: Tables, state: State, lanes: int, first: int, last: int) -> None:
    """Run the skills first..last of the table: each only in the lanes where it has influence.

    It ends where a procedure fails: `failed` then says which, and for whose inputs.
    """
    mind, failed = state.mind, state.run.failed
    for row in range(first, last):
        count = wake(tables, state, lanes, row)
        if count > 0:
            skill, out = tables.skills[row], 0
            if skill.address == 0:
                out = compute(skill.lane, tables, mind, skill, count)
            else:
                failed[FAILED_COLUMN] = call_procedure(skill.address, mind.gathered, mind.hidden, count)
                if failed[FAILED_COLUMN] >= 0:
                    failed[FAILED_SKILL] = row
                    return
            send(tables, state, row, out, count, lanes)


@unit
def wake(tables: Tables, state: State, lanes: int, row: int) -> int:
    """Gather the inputs of a skill in the lanes where it has influence; return their number."""
    skill, mind = tables.skills[row], state.mind
    count: int = awake(mind.influence[skill.index], mind.active, lanes, skill.own)
    if count > 0:
        rows = tables.inputs[skill.input : skill.input + skill.inputs]
        gather(rows, mind.readings, mind.gathered, mind.active, mind.sound, count, count == lanes)
    return count


def awake(influence, active, lanes, own):
    """List the lanes in which a skill has influence; all, if any, where each has its own weights. Return the count."""
    count = 0
    if not own:
        for lane in range(lanes):
            active[count] = lane
            count += 1 if influence[lane] != ZERO else 0  # NaN too, which becomes a fault further down
        return count
    for lane in range(lanes):
        active[lane] = lane
        count += 1 if influence[lane] != ZERO else 0
    return lanes if count > 0 else 0


def gather(rows, readings, gathered, active, sound, count, everywhere):
    """Copy the inputs of a skill side by side; `sound` becomes 0 where all of them are finite, else NaN."""
    sound[:count] = ZERO
    for j in range(len(rows)):
        source, target = readings[rows[j]], gathered[j]
        if everywhere:
            for k in range(count):
                target[k] = source[k]
                sound[k] += source[k] - source[k]
        else:
            for k in range(count):
                target[k] = source[active[k]]
            for k in range(count):
                sound[k] += target[k] - target[k]


@unit
def send(tables: Tables, state: State, row: int, out: int, count: int, lanes: int) -> None:
    """Send every edge's value, times the skill's influence, to its target; a value that is not finite is not sent."""
    skill, mind, everywhere = tables.skills[row], state.mind, count == lanes
    influence = mind.influence[skill.index]
    if skill.chooses > 0:
        choose(tables, state, row, out, count, everywhere)
    for e in range(skill.edge, skill.edge + skill.edges):
        edge, sent = tables.edges[e], mind.sent
        evaluate_edge(tables, state, out, e, count, everywhere)
        values = mind.hidden[out + edge.output] if edge.output >= 0 else mind.values
        values = mind.gated if edge.whens > 0 else values
        check(values, mind.sound, sent, mind.active, state.run.faults, influence, count)
        if edge.whens > 0 and edge.others == 0:
            for k in range(count):  # nothing is sent where a condition does not hold, and that is no fault
                sent[k] = NOT_SENT if mind.opened[k] == ZERO and mind.sound[k] == ZERO else sent[k]
        for k in range(count if skill.chooses > 0 and edge.to_skill else 0):
            if sent[k] >= ZERO:
                sent[k] = ONE if mind.chosen[k] == e else ZERO
        if edge.scopes > 0:
            spread_scoped(tables, mind, row, e, count)
        for k in range(count if edge.cuts > ZERO else 0):
            if sent[k] >= ZERO:  # nothing is sent where the influence that arrives would be smaller than the least
                sent[k] = NOT_SENT if sent[k] * influence[mind.active[k]] < edge.cuts else sent[k]
        if not everywhere:
            sent = widen(sent, mind.gated, mind.active, count, lanes)
        if edge.to_skill:
            spread(sent, influence, mind.influence[edge.target], lanes)
        else:
            behind = mind.scoped[edge.scope + skill.index] if edge.scope >= 0 else influence
            spread(sent, behind, mind.command_sums[edge.target], lanes)
            for lane in range(lanes):  # now the influence behind each command (Eq. 3)
                sent[lane] = ONE if sent[lane] >= ZERO else NOT_SENT
            spread(sent, behind, mind.influence_sums[edge.target], lanes)


def evaluate_edge(tables, state, out, e, count, everywhere):
    """Write the values of edge e, where they are not outputs of the function, to `values`, or behind `when` `gated`."""
    edge = tables.edges[e]
    if edge.output < 0:
        value(tables, state, edge.code, edge.length, state.mind.values, count, everywhere)
    if edge.whens > 0:
        gate(tables, state, out, e, count, everywhere)


@unit_where(lambda tables: (tables.skills["chooses"] > 0).any())
def choose(tables: Tables, state: State, row: int, out: int, count: int, everywhere: int) -> None:
    """Find the influence of a skill that is greatest before the clamp, of equals the first, among those that are sent.

    Lane by lane: its edge in `chosen`, −1 where none is sent.
    """
    skill, mind = tables.skills[row], state.mind
    mind.chosen[:count] = -1
    for e in range(skill.edge, skill.edge + skill.edges):
        edge = tables.edges[e]
        if edge.to_skill:
            evaluate_edge(tables, state, out, e, count, everywhere)
            values = mind.hidden[out + edge.output] if edge.output >= 0 else mind.values
            values, closes = mind.gated if edge.whens > 0 else values, edge.whens > 0 and edge.others == 0
            for k in range(count):
                can_be = finite(values[k]) and not (closes and mind.opened[k] == ZERO)
                if can_be and (mind.chosen[k] < 0 or values[k] > mind.greatest[k]):
                    mind.chosen[k], mind.greatest[k] = e, values[k]


@unit_where(lambda tables: (tables.edges["scopes"] > 0).any())
def spread_scoped(tables: Tables, mind: MindState, row: int, e: int, count: int) -> None:
    """Add value times influence (Eq. 2) in the further scopes in which edge e counts, where it is not cut there."""
    skill, edge = tables.skills[row], tables.edges[e]
    for scope in tables.inputs[edge.scoped : edge.scoped + edge.scopes]:
        behind, target = mind.scoped[scope + skill.index], mind.scoped[scope + edge.target]
        for k in range(count):
            lane = mind.active[k]
            sent = mind.sent[k] * behind[lane]
            if mind.sent[k] >= ZERO and not sent < edge.cuts:
                target[lane] += sent


def widen(sent, wide, active, count, lanes):
    """Return `wide` with what is sent in each of the lanes."""
    wide[:lanes] = NOT_SENT
    for k in range(count):
        wide[active[k]] = sent[k]
    return wide


def value(tables, state, first, length, out, count, everywhere):
    """Evaluate a program over the readings into `out`, in float32."""
    run_program(tables, state, first, length, 0, count, everywhere)
    for k in range(count):
        out[k] = F(state.mind.stack[0, k])


@unit
def run_program(tables: Tables, state: State, first: int, length: int, each: int, count: int, everywhere: int) -> None:
    """Leave the values of a program in stack[0], for the lanes active[0..count], or 0..count where `everywhere`."""
    mind, measures, codes = state.mind, state.judge.measures, tables.codes[first : first + length]
    evaluate(codes, mind.readings, measures, mind.commands, each, mind.stack, mind.active, count, everywhere)


@unit_where(lambda tables: (tables.edges["whens"] > 0).any())
def gate(tables: Tables, state: State, out: int, e: int, count: int, everywhere: int) -> None:
    """Write the values of edge e where its condition holds, those of `otherwise` where not, NaN where nobody knows."""
    edge, mind, other = tables.edges[e], state.mind, state.mind.other
    values = mind.hidden[out + edge.output] if edge.output >= 0 else mind.values
    value(tables, state, edge.when, edge.whens, mind.opened, count, everywhere)
    other[:count] = ZERO
    if edge.others > 0:
        value(tables, state, edge.other, edge.others, other, count, everywhere)
    for k in range(count):
        is_open, is_closed = mind.opened[k] > ZERO, mind.opened[k] == ZERO
        mind.gated[k] = values[k] if is_open else other[k] if is_closed else NAN


def check(values, sound, sent, active, faults, influence, count):
    """Write the values clamped to 0..1 to `sent`; −1, and a fault, where one or an input of its skill is not finite."""
    broken = 0
    for k in range(count):
        fine = finite(values[k]) & (sound[k] == ZERO)
        sent[k] = clamp(values[k]) if fine else NOT_SENT
        broken += 0 if fine else 1
    if broken > 0:
        for k in range(count):
            faults[active[k]] += 1 if sent[k] < ZERO and influence[active[k]] != ZERO else 0


def spread(sent, influence, target, lanes):
    """Add value times influence (Eq. 2) where a value is sent."""
    for lane in range(lanes):
        target[lane] += sent[lane] * influence[lane] if sent[lane] >= ZERO else ZERO
