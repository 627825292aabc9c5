"""A proposal as lines of a source with their evidence, as data, and in words."""

from collections.abc import Iterator
from typing import Any

from mindlang.compiler.diagnostic import listed
from mindlang.number_format import finite, tick_count
from mindlang.propose.candidates import BIAS, Candidate
from mindlang.propose.search import Proposal
from mindlang.propose.trial import Stage

MOST_NOT_TAKEN = 8  # that are named


def proposed_lines(stage: Stage, found: Proposal) -> list[str]:
    """The lines to add, each with its evidence behind it; none where a taught skill does the task as it is."""
    candidate, remarks = found.winner.candidate, dict[str, str]()
    if candidate.way in ("nothing", "unchanged"):
        return []
    if candidate.way == "like":
        learnt = max((score for *_, score in found.tried), default=found.nothing)
        remarks[""] = f"{found.winner.score:.1f} as it is; the best that was taught anew {learnt:.1f}"
    for name in candidate.reads:
        if name in found.worth:
            remarks[name] = f"{_amount(found.worth[name])} over its mean"
    if BIAS in candidate.reads:
        remarks[BIAS] = "a constant, without which it does worse"
    for line in candidate.sends:
        verb, name, *_ = line.split()
        if verb == "influences" and name in found.probes:
            remarks[line] = f"alone {found.probes[name]:.1f}"
        if name in found.worth:
            remarks[line] = f"{_amount(found.worth[name])} over being without it"
    return stage.lines(candidate, remarks)


def proposal_data(stage: Stage, found: Proposal, seconds: float, diff: str) -> dict[str, Any]:
    """The proposal and its evidence as plain data; gains are with their standard errors."""
    return {
        "task": stage.task,
        "skill": stage.skill,
        "seed": stage.seed,
        **_candidate_data(found.winner.candidate),
        "score": finite(found.winner.score),
        "nothing": finite(found.nothing),
        "probes": {name: finite(score) for name, score in found.probes.items()},
        "constant": stage.known.constants,
        "worth": {name: [*map(finite, pair)] for name, pair in found.worth.items()},
        "refused": {name: [*map(finite, pair)] for name, pair in found.refused.items()},
        "tried": [
            {**_candidate_data(candidate), "generations": generations, "score": finite(score)}
            for candidate, generations, score in found.tried
        ],
        "ticks": found.ticks,
        "seconds": round(seconds, 3),
        "diff": diff,
    }


def _candidate_data(candidate: Candidate) -> dict[str, Any]:
    return {
        "way": candidate.way,
        "origin": candidate.origin or None,
        "reads": [*candidate.reads],
        "sends": [*candidate.sends],
    }


def proposal_sentences(stage: Stage, found: Proposal) -> Iterator[str]:
    """What was found, what it comes to, and what was not taken, in words."""
    candidate, scores = found.winner.candidate, f"{found.winner.score:.1f}, and nothing at all {found.nothing:.1f}"
    spent = f"{len(found.tried) + len(found.probes)} candidates, {tick_count(found.ticks)} ticks"
    match candidate.way:
        case "nothing":
            yield f"{stage.task}: of {spent} none does better than nothing ({found.nothing:.1f})"
            return
        case "unchanged":
            yield f"{stage.task}: {candidate.origin} does it as it is, and scores {scores}; {spent}"
            return
        case "like":
            yield f"{stage.task}: {candidate.origin} does it with its readings exchanged, and scores {scores}; {spent}"
        case _:
            read, below = {*candidate.reads} - {BIAS}, candidate.subskills
            all_of = f"{len(read)} of {len(stage.known.mind.sensors)} sensors"
            skills = f"{len(below)} of {len(stage.known.mind.skills)} skills"
            yield f"{stage.task}: {all_of}, {skills}, and scores {scores}; {spent}"
    refused = sorted(found.refused.items(), key=lambda item: -item[1][0])
    words = [f"{name} ({_amount(pair)})" for name, pair in refused[:MOST_NOT_TAKEN]]
    if words:
        yield f"not taken: {listed(words, 'and')}"
    if constant := stage.known.constants:
        yield f"cannot change in {stage.task}: {listed([*constant], 'and')}"


def _amount(pair: tuple[float, float]) -> str:
    return f"{pair[0]:+.1f} ± {pair[1]:.1f}"
