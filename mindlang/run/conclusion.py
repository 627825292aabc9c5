"""What may be said of two minds that ran on the same layouts: a sentence, and no more than its interval says."""

from collections.abc import Mapping
from math import ceil, floor, log10

from mindlang.number_format import score
from mindlang.run.paired_difference import CONFIDENCE_LEVEL, Difference

SCORE, SUCCESS = "score", "success"  # the figures that are no events
PERCENT = f"{CONFIDENCE_LEVEL:.0%}".replace("%", " %")
MIN_DIGITS = 2  # behind the point
NOTHING_IN_COMMON = "There is no figure that both have: they are paid for other rewards, and count other events."


def conclusion(first: str, second: str, task: str, differences: Mapping[str, Difference]) -> str:
    """Which of two minds does better on a task, by the first of the figures."""
    if not differences:
        return NOTHING_IN_COMMON
    name, found = next(iter(differences.items()))
    if found.not_finite:
        return f"In {_runs(found.not_finite)} the {name} is not a finite number, so that nothing can be said."
    if not found.differing:
        return (
            f"{first} and {second} come to the same {name} in {_runs(found.runs)}: they differ on at most "
            f"{100 * found.most_that_differ:.2g} % of the layouts of {task} ({PERCENT} confidence)."
        )
    if found.low is None or found.high is None:
        return f"A single run says nothing of other layouts of {task}."
    if found.leaves_zero_out:
        return _which_does_more(first, second, task, name, found, found.low, found.high)
    low, high = amount(name, -found.low, found), amount(name, found.high, found)
    verb, of_what = _words(name)
    return (
        f"{_runs(found.runs)} do not tell {second} from {first}: on layouts of {task}, {second} {verb} from {low} less "
        f"to {high} more{of_what} on average ({PERCENT} confidence){_unseen(found)}."
    )


def conclusion_of_one_world(first: str, second: str, task: str, differences: Mapping[str, Difference]) -> str:
    """Which of two minds does better where nothing is drawn: each has one run, and that says it all."""
    if not differences:
        return NOTHING_IN_COMMON
    name, found = next(iter(differences.items()))
    if found.mean is None:
        return f"The {name} is not a finite number, so that nothing can be said."
    if not found.differing:
        return f"{first} and {second} come to the same {name} in the one world of {task}."
    better, worse = (second, first) if found.mean > 0 else (first, second)
    verb, of_what = _words(name)
    more = amount(name, abs(found.mean), found)
    return f"In the one world of {task}, {better} {verb} {more} more{of_what} than {worse}."


def amount(name: str, value: float, found: Difference) -> str:
    """A difference, or one of its bounds, with as many digits as its standard error has a use for."""
    if name == SUCCESS:
        return f"{100 * value:.1f} percentage points"
    error = found.standard_error
    return score(value, max(MIN_DIGITS, 1 - floor(log10(error))) if error else MIN_DIGITS)


def _which_does_more(first: str, second: str, task: str, name: str, found: Difference, low: float, high: float) -> str:
    """The one that does more comes first."""
    better, worse, bounds = second, first, (low, high)
    if high < 0:
        better, worse, bounds = first, second, (-high, -low)
    verb, of_what = _words(name)
    mean, least, most = (amount(name, value, found) for value in (abs(found.mean or 0.0), *bounds))
    return (
        f"On layouts of {task}, {better} {verb} {mean} more{of_what} than {worse} on average, and with {PERCENT} "
        f"confidence {least} to {most} more{_unseen(found)}."
    )


def _unseen(found: Difference) -> str:
    """What the runs need not have shown."""
    return f", but for what happens on less than 1 layout in {ceil(1 / found.most_that_differ)}"


def _words(name: str) -> tuple[str, str]:
    """The verb of a figure, and what there is more of."""
    return {SCORE: ("scores", ""), SUCCESS: ("succeeds", " often")}.get(name, ("counts", f" ({name})"))


def _runs(count: int) -> str:
    return "1 run" if count == 1 else f"{count:,} runs"
