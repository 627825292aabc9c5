"""Who does what in a team: the skill that has the most influence on each robot, and how labour is divided by that.

The skills that the master influences are compared: who is in charge decides what a robot does, those below how.
"""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from mindrun.graph.graph import Edge, Graph
from mindrun.sim.lanes.advance import before
from mindrun.sim.rollout import Rollout
from numpy.typing import NDArray
from rich.console import RenderableType
from rich.text import Text

from mindlang.compiler.diagnostic import listed
from mindlang.run.outcome import spread
from mindlang.run.setup import NO_GENOME
from mindlang.run.summary import aligned, shortened

MOST_ROBOT_TICKS, MOST_RUNS = 4_000_000, 200  # of many runs: two seconds or so
CHANCE_PIECES, CHANCE_SHUFFLES = 10, 20  # of a run whose robots are shuffled, and how often they are
NO_ROLE = -1
MOST_ROWS, MOST_COLUMNS, ROOM_COLUMNS = 16, 6, 64  # of a table; for names, in a terminal of 80
LEAST_SHARE = 0.005  # that is shown
Roles = NDArray[np.int16]  # [ticks, robots]: a place among the skills that are compared, or NO_ROLE
Times = NDArray[np.int64]  # [robots, skills]: ticks


def compared_skills(graph: Graph, master: int) -> list[int]:
    """The places of the skills between which a master shares out influence; where that is one alone, of those below it.

    Without those that always have all of it (`at 1`), which nobody chooses. One where there is no choice.
    """
    while True:
        skill = graph.skills[master]
        chosen = dict.fromkeys(
            edge.target for edge in skill.edges if edge.to == "skill" and (skill.chooses or not _is_always(edge))
        )
        if len(chosen) != 1:
            return [*chosen] or [master]
        [master] = chosen


def _is_always(edge: Edge) -> bool:
    """True if an edge sends 1, whatever is read."""
    match edge.value:
        case (("number", value),):
            return edge.output is None and edge.gate is None and value >= 1
    return False


def team_of(rollout: Rollout) -> list[int]:
    """The numbers of the robots that are paid: others are a part of the world."""
    return np.flatnonzero(rollout.tables.robots["paid"]).tolist()


def roles_of(rollout: Rollout, skills: Sequence[int], seeds: Sequence[int]) -> list[Roles]:
    """The role of each robot of the team in each tick of the runs of these seeds, which are made again: the skill that
    has the most influence, of equals the first; NO_ROLE where none has any.
    """
    robots, team, rows = len(rollout.tables.robots), team_of(rollout), [*skills]
    jobs = rollout.jobs(NO_GENOME, np.array(seeds, np.uint64))
    tile = rollout.tile(max(1, min(len(seeds), rollout.lanes // robots)))
    rollout.fill(tile, jobs)
    mind, world, run = tile.state.mind, tile.state.world, tile.state.run
    roles = np.full((len(seeds), int(jobs.most[0]), len(team)), NO_ROLE, np.int16)
    while lanes := int(jobs.lanes[0]):
        rollout.observe(tile, jobs)
        before(rollout.tables, tile.state, jobs)
        rollout.think(tile, jobs, 0, len(rollout.tables.skills))
        influence, first = mind.influence[rows, :lanes], slice(0, lanes, robots)
        role = np.where(influence.max(axis=0) > 0, influence.argmax(axis=0), NO_ROLE)
        roles[run.job[first], world.tick[first]] = role.reshape(-1, robots)[:, team]
        rollout.conclude(tile, jobs)
    return [each[:ticks] for each, ticks in zip(roles, jobs.ticks.tolist(), strict=True)]


def times_of(roles: Roles, skills: int) -> Times:
    """In how many ticks each robot had each of so many skills as its role."""
    return np.array([np.bincount(own[own != NO_ROLE], minlength=skills) for own in roles.T])


def division_of_labour(times: Times) -> float | None:
    """I(robot; skill) / H(skill) of a table of times, 0 to 1; None where one skill alone has any.

    The mutual entropy over the marginal entropy of the skills (Gorelick et al. 2004): the share of what is open about
    a role that is known with the robot. So it is 1 where each robot has one role for ever, also where several share it,
    and 0 where all robots spend their time alike. Over the entropy of the robots, the other way, four robots in two
    roles would never come to 1.
    """
    skills = times.sum(axis=0)
    if np.count_nonzero(skills) < 2:
        return None
    known = _entropy(times.sum(axis=1)) + _entropy(skills) - _entropy(times)
    return max(0.0, float(known / _entropy(skills)))


def _entropy(times: NDArray[np.integer]) -> float:
    share = times[times > 0] / times.sum()
    return float(-(share * np.log(share)).sum())


def by_chance(roles: Roles, skills: int, random: np.random.Generator) -> float:
    """The division of labour of a run that has one, after it is cut into pieces and the robots are shuffled in each.

    So much is left where nobody keeps a role for longer than a piece. The mean of many shuffles.

    To shuffle them in each tick would say less: robots that are all alike keep a role for a while, and look divided.
    """
    pieces = [times_of(piece, skills) for piece in np.array_split(roles, CHANCE_PIECES)]
    shuffled = [np.sum([*map(random.permutation, pieces)], axis=0) for _ in range(CHANCE_SHUFFLES)]
    return float(np.mean([division_of_labour(times) or 0.0 for times in shuffled]))


def roles_data(rollout: Rollout, seeds: Sequence[int]) -> dict[str, Any]:
    """The `roles` of a team in the first of the runs of these seeds, as data; nothing of one robot.

    So many runs that they have MOST_ROBOT_TICKS together, and one at least; none where there is nothing to choose.
    """
    team, graph, robots = team_of(rollout), rollout.graph, rollout.tables.robots
    if len(team) == 1:
        return {}
    masters = dict.fromkeys(robots["master"][team].tolist())
    skills = [*dict.fromkeys(skill for master in masters for skill in compared_skills(graph, master))]
    most = max(1, min(MOST_RUNS, MOST_ROBOT_TICKS // (len(robots) * rollout.task.ticks)))
    made = roles_of(rollout, skills, seeds[:most]) if len(skills) > 1 else []
    runs = [
        {"run": number, "seed": int(seed), **_run_data(roles, len(skills), seed)}
        for number, (seed, roles) in enumerate(zip(seeds, made, strict=False), 1)
    ]
    divided = {how: [run[how] for run in runs if run[how] is not None] for how in ("division_of_labour", "by_chance")}
    return {
        "roles": {
            "robots": team,
            "skills": [graph.skills[place].name for place in skills],
            **{how: spread("", np.array(values)) for how, values in divided.items()},
            "runs": runs,
        }
    }


def _run_data(roles: Roles, skills: int, seed: int) -> dict[str, Any]:
    """The division of labour of a run, that by chance, and which share of the run each robot had each role."""
    times = times_of(roles, skills)
    divided = division_of_labour(times)
    chance = None if divided is None else by_chance(roles, skills, np.random.default_rng(seed))
    return {"division_of_labour": divided, "by_chance": chance, "shares": (times / max(1, len(roles))).tolist()}


def roles_text(found: dict[str, Any]) -> Iterator[RenderableType]:
    """Who does what in the run of median division, and the division of labour of all; nothing of one robot."""
    if not (roles := found.get("roles")):
        return
    yield ""
    runs = [run for run in roles["runs"] if run["division_of_labour"] is not None]
    if not runs:
        had = [
            name
            for i, name in enumerate(roles["skills"])
            if any(own[i] for run in roles["runs"] for own in run["shares"])
        ]
        had = had if roles["runs"] else roles["skills"]
        yield f"no division of labour: {listed(had, 'or') + ' alone' if had else 'no skill'} is the role of all robots"
        return
    runs.sort(key=lambda run: float(run["division_of_labour"]))
    yield _role_table(roles, runs[(len(runs) - 1) // 2])
    error, made = roles["division_of_labour"]["standard_error"], len(roles["runs"])
    said = f"{roles['division_of_labour']['mean']:.3f}" + (f" ± {error:.3f}" if error is not None else "")
    yield Text(f"division of labour {said}, by chance {roles['by_chance']['mean']:.3f}", "bold")
    of = f"of the first {made:,} runs" if made < found["runs"] else f"of {made:,} run{'s' * (made != 1)}"
    alone = f", but {made - len(runs):,} of one role alone" if len(runs) < made else ""
    yield Text(f"{of}{alone}; above, that of median division" if len(runs) > 1 else f"{of}{alone}", "dim")


def _role_table(roles: dict[str, Any], run: dict[str, Any]) -> Text:
    """A row for each robot with its share of each role, the most frequent first; beyond MOST_COLUMNS they are one."""
    shares = np.array(run["shares"])
    order = np.argsort(-shares.sum(axis=0), kind="stable")
    columns = {roles["skills"][i]: shares[:, i] for i in order[:MOST_COLUMNS]}
    columns |= {"others": shares[:, order[MOST_COLUMNS:]].sum(axis=1), "nobody": 1 - shares.sum(axis=1)}
    columns = {name: each for name, each in columns.items() if (each >= LEAST_SHARE).any()}
    head = f"roles in run {run['run']}", *(shortened(name, ROOM_COLUMNS // len(columns) - 2) for name in columns)
    cells = ([f"{share:.0%}" for share in each] for each in columns.values())
    rows = [*zip((f"robot {number}" for number in roles["robots"]), *cells, strict=True)]
    rows[MOST_ROWS:] = [(f"… {len(rows) - MOST_ROWS} more", *[""] * len(columns))] if len(rows) > MOST_ROWS else []
    return aligned(rows, (0,), head)
