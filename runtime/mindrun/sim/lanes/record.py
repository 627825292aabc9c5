"""Record: a row of what the first lane's world and mind are after a tick."""

from mindrun.sim.compiling import compiled


@compiled
def record(state, jobs):
    """Write a row in the order of `mindrun.sim.ticks`, where there is room for one.

    Before the memory cells recall: a row has them as the skills read them.
    """
    if jobs.recorded[0] == len(jobs.singles):
        return
    world, mind, judge = state.world, state.mind, state.judge
    row = jobs.doubles[jobs.recorded[0]]
    at = copy(world.body, row, 0)
    at = copy(world.things, row, at)
    at = copy(world.loose, row, at)
    at = copy(world.direction, row, at)
    at = copy(world.grip, row, at)
    at = copy(judge.lines, row, at)
    at = copy(judge.events, row, at)
    row[at], row[at + 1], row[at + 2] = world.held[0], world.battery[0], state.contact.touching[0] & 1
    narrow = jobs.singles[jobs.recorded[0]]
    at = copy(mind.readings, narrow, 0)
    at = copy(mind.influence, narrow, at)
    at = copy(mind.commands, narrow, at)
    copy(world.acting, narrow, at)
    jobs.recorded[0] += 1


@compiled
def copy(rows, target, at):
    """The first lane of all rows, from `at` on; where the next ones begin."""
    for row in range(len(rows)):
        target[at + row] = rows[row, 0]
    return at + len(rows)
