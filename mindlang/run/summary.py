"""The outcome of a run, of many runs, and of two minds on the same layouts, as text to read."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from mindrun.graph.draws import drawn_in_words
from mindrun.sim.outside.making import GAVE_NO_NUMBER
from rich.cells import cell_len, set_cell_size
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.number_format import duration, finite, score, speed
from mindlang.run.comparison import PERCENT, SCORE, SUCCESS, MindComparison, amount
from mindlang.run.outcome import TIME, robot_words
from mindlang.run.paired_difference import MAX_RUNS, PairedDifference
from mindlang.run.worlds import figure

LINE_COLUMNS = 80
PROMISE_COLUMNS = 46  # for a skill and what it promises
WHERE_COLUMNS = 26  # for the name of a world or a skill beside it
WORLD_COLUMNS = 52  # for the name of a world beside one mind; half of them beside two

Row = Sequence[str | Text]
Promised = Sequence[dict[str, Any]]
Elsewhere = tuple[str, Promised, Mapping[str, Promised]]  # a mind, its promises here, and those elsewhere


def run_summary(found: dict[str, Any]) -> RenderableType:
    """One run: how it ended, what it counted, and what each reward line paid."""
    ended = f"ended by {found['ended_by']}" if found["ended_by"] else "lasted its time"
    ended += ", a success" * found.get("succeeded", False)
    whose = robot_words(found) if found.get("robot") or found.get("stopped") else ""
    facts = _facts(
        ("seed", f"{found['seed']}{whose}{drawn_in_words(found.get('drawn', {}))}"),
        *_counted({event: f"{times} × " for event, times in found["by_event"].items()}),
        ("ticks", f"{found['ticks']:,} of {found['of_ticks']:,}, {ended}"),
        ("faults", _faults(found)),
    )
    sums = [(score(paid), text) for text, paid in found["by_line"].items()]
    total = (Text(score(found["score"]), "bold"), "score")
    return Group(_title(found), facts, "", aligned([*sums, total], left=(1,)), *_promises(found))


def bench_summary(found: dict[str, Any]) -> RenderableType:
    """Many runs: means with their standard errors, how they ended, how fast they were."""
    runs = found["runs"]
    cores = "core" if found.get("workers") == 1 else "cores"
    who = f"by {found['on']}" if "on" in found else f"on {found['workers']} {cores}"
    error = "; ± is the standard error of the mean" if runs > 1 else ""
    ended = ", ".join(
        f"{'lasted its time' if name == TIME else name}: {n / runs:.0%}" for name, n in found["ended"].items()
    )
    best, worst = (f"{found['seed']}/{found[run]}" if found[run] else "" for run in ("best_run", "worst_run"))
    best_drawn, worst_drawn = (drawn_in_words(found.get(f"{run}_drawn") or {}) for run in ("best", "worst"))
    facts = _facts(
        ("runs", f"{runs} from seed {found['seed']}{error}"),
        *_counted(
            {event + _per_robot(found, each): f"{_mean(each, '')}   " for event, each in found["by_event"].items()}
        ),
        ("success", _share(found["success"]) if "success" in found else ""),
        ("score", _mean(found, "score_")),
        ("run time", f"{found['runtime_mean']:.1%} of the task's ticks"),
        ("ended by", ended),
        ("best run", best and f"seed {best}{best_drawn}: mindc run --seed {best} repeats it"),
        ("worst run", worst and f"seed {worst}{worst_drawn}"),
        ("speed", f"{speed(found)} {who}, in {duration(found['seconds'])}"),
        ("faults", _faults(found)),
    )
    return Group(_title(found), facts, *_goals(found), *_promises(found))


def _per_robot(found: dict[str, Any], times: Mapping[str, Any]) -> str:
    return f" ({score(times['mean'] / len(found['roles']['robots']))} per robot)" if "roles" in found else ""


def _goals(found: dict[str, Any]) -> Iterator[RenderableType]:
    """A row for each goal: how much of it was met in the mean, and in how many runs all of it."""
    if goals := found.get("goals"):
        rows = [
            (
                shortened(each["goal"], PROMISE_COLUMNS),
                "–" if each["mean"] is None else f"{each['mean']:.1%}",
                "" if each["met"] is None else f"{round(each['met'] * found['runs']):,}",
            )
            for each in goals
        ]
        yield ""
        yield aligned(rows, (0,), ("goal", "met", f"all of it in {found['runs']:,} runs"))


def _promises(found: dict[str, Any]) -> Iterator[RenderableType]:
    """A row for each promise: in which share of the times that it was judged it held, and how often who broke it."""
    promises = found.get("promises", ())
    if not promises:
        return
    runs = promises[0]["runs"]
    of = "" if runs == found.get("runs", 1) else f" in the first {runs} run{'s' * (runs != 1)}"
    head = (f"promised{of}", "held", "by it", "above it", *(["runs"] if runs > 1 else []))
    yield ""
    yield aligned(map(_promise_row, promises), (0,), head)
    for each in (each for each in promises if each.get("unfinished")):
        many = "the run" if runs == 1 else f"{each['unfinished']:,} of {runs:,} runs"
        yield Text(f"{many} ended while {each['skill']} was acting: not judged what it achieves", "dim")
    if any(each["broken_runs"] for each in promises):
        yield Text("broken by it, or above it: influenced against what it requires", "dim")


def _promise_row(found: dict[str, Any]) -> list[str | Text]:
    by = [found.get(whose) for whose in ("by_skill", "by_influence")]
    judged = found["held"] + sum(filter(None, by))
    share = f"{found['held'] / judged:.1%}" if judged else "–"
    held = "< 100%" if share == "100.0%" and found["held"] < judged else share
    runs = [f"{found['broken_runs']}"] if found["runs"] > 1 else []
    return [
        shortened(f"{found['skill']} {found['promise']}", PROMISE_COLUMNS),
        held,
        *("" if many is None else f"{many:,}" for many in by),
        *runs,
    ]


def _broken_by_both(minds: Sequence[dict[str, Any]]) -> Iterator[RenderableType]:
    """A row for each promise: in how many runs of two minds it was broken; – where one does not promise it."""
    both = [{f"{each['skill']} {each['promise']}": each for each in mind.get("promises", ())} for mind in minds]
    if names := [*(both[0] | both[1])]:
        rows = [(shortened(name, PROMISE_COLUMNS), *(_broken(each.get(name)) for each in both)) for name in names]
        yield aligned(rows, (0,), ("promise broken in", "A", "B"))
        yield ""


def _broken_elsewhere(
    heads: tuple[str, str, str], minds: Sequence[Elsewhere], is_silent: bool = False
) -> Iterator[RenderableType]:
    """A row for each promise of minds: in how many runs it was broken here, and there where it was in most.

    Where a skill `is_silent` there, what it promises itself is left out.
    """
    rows = [("", *heads)]
    for name, here, there in minds:
        for i, promise in enumerate(here):
            silent = promise["skill"] if is_silent else None
            others = {where: promises[i] for where, promises in there.items() if where != silent}
            share = {where: each["broken_runs"] / each["runs"] for where, each in others.items()}
            worst = max(share, key=share.__getitem__, default="")
            is_worse = share.get(worst, 0) > promise["broken_runs"] / promise["runs"]
            where = shortened(worst if is_worse else "", WHERE_COLUMNS)
            of = f"{name}{promise['skill']} {promise['promise']}"
            rows.append((of, _broken(promise), _broken(others.get(worst)), where))
    if len(rows) > 1:
        room = LINE_COLUMNS - sum(2 + max(map(len, column)) for column in [*zip(*rows, strict=True)][1:])
        yield ""
        yield aligned(([shortened(of, room), *row] for of, *row in rows[1:]), (0, 3), ("promise broken in", *heads))


def _broken(found: dict[str, Any] | None) -> str:
    return f"{found['broken_runs']} of {found['runs']}" if found else "–"


def _title(found: dict[str, Any]) -> Text:
    return Text.assemble((found["task"], "bold"), f" with {found['master']} in charge")


def _mean(found: dict[str, Any], of: str) -> str:
    error = found[f"{of}standard_error"]
    if error == 0:
        return f"{score(found[f'{of}mean'])} in every run"
    return score(found[f"{of}mean"]) + (f" ± {error:.2f}" if error is not None else "")


def _share(found: dict[str, Any]) -> str:
    """A share of the runs ± its standard error; where it is all or none, with the bound for all layouts instead."""
    error, mean = found["standard_error"], found["mean"]
    if found["at_least"] is not None:
        bound = f"at least {found['at_least']:.1%}" if mean else f"at most {found['at_most']:.1%}"
        return f"{mean:.1%} of the runs, {bound} of all layouts (95 % confidence)"
    return f"{mean:.1%}" + (f" ± {error:.1%}" if error is not None else "") + " of the runs"


def _counted(counts: dict[str, str]) -> list[tuple[str, str]]:
    """A row for each event, the first one labelled `counted`."""
    width = max(map(len, counts.values()), default=0)
    rows = [f"{count:>{width}}{event}" for event, count in counts.items()]
    return [("" if i else "counted", row) for i, row in enumerate(rows)]


def _faults(found: dict[str, Any]) -> str:
    faults = found.get("faults", 0)  # of a run that was stopped nobody knows them
    values = "value was not a finite number" if faults == 1 else "values were not finite numbers"
    is_its = any(GAVE_NO_NUMBER in note for note in found.get("notes", ()))
    why = "the environment gave such itself, as the note says" if is_its else "a division by zero?"
    return f"{faults:,} {values}: {why}" if faults else ""


def _facts(*rows: tuple[str, str]) -> Text:
    return aligned([(Text(name, "dim"), value) for name, value in rows if value], (1,))


def comparison_summary(found: dict[str, Any], comparison: MindComparison) -> RenderableType:
    """Both means of each figure, their difference with its interval, how often each did better, and the conclusion."""
    runs, seed, is_one_world = found["runs"], found["seed"], comparison.is_one_world
    where = f"on the same layouts, {runs:,} run{'s' * (runs != 1)} from seed {seed}"
    ours, theirs = comparison.first.figures(), comparison.second.figures()
    head = ("", "A", "B", "B − A", f"{PERCENT} confidence")
    rows = [
        (name, *(_figure(name, mean[name].mean()) for mean in (ours, theirs)), *_difference(name, each))
        for name, each in comparison.differences.items()
    ]
    told = () if is_one_world else [*comparison.differences.items()][:1]
    columns = len(head) - is_one_world  # of one run nothing is inferred
    return Group(
        Text.assemble((found["task"], "bold"), " in its one world" if is_one_world else f" {where}"),
        *(
            Text(f"  {place}  {each['file']} with {each['master']} in charge")
            for place, each in zip("AB", found["minds"], strict=True)
        ),
        "",
        aligned([["", *row[:columns]] for row in rows], (0, 1), ["", *head[:columns]]),
        "",
        *_broken_by_both(found["minds"]),
        *(Text(line, "dim") for each in told for line in _told(*each)),
        Text(comparison.conclusion, "bold"),
    )


def _figure(name: str, value: float | None) -> str:
    if name == SUCCESS and value is not None:
        return f"{100 * value:.1f} %"
    return score(None if value is None else finite(value))


def _difference(name: str, found: PairedDifference) -> tuple[str, str]:

    def bound(value: float) -> str:
        return f"{100 * value:.1f} %" if name == SUCCESS else amount(name, value, found)

    if found.mean is None:
        return "–", ""
    difference = "+" * (found.mean >= 0) + bound(found.mean)
    if found.low is None or found.high is None:
        return difference, "no interval" if found.differing else "no run differs"
    return difference, f"{bound(found.low)} to {bound(found.high)}"


def _told(name: str, found: PairedDifference) -> Iterator[str]:
    """Sentences: how many runs did better and, where they do not tell the minds apart, how many would."""
    more = {SCORE: "B scores more", SUCCESS: "B alone succeeds"}.get(name, f"B has more ({name})")
    less = {SUCCESS: "A alone"}.get(name, "less")
    yield f"{more} in {found.more:,} runs, {less} in {found.less:,}, as much in {found.equal:,}"
    if found.is_widened:
        yield (
            f"the interval is as wide as layouts can make it of which {found.runs:,} runs need have no example: "
            f"up to {100 * found.most_that_differ:.2g} % of all"
        )
    if found.detectable is not None and found.mean is not None and not found.leaves_zero_out:
        needed = f"about {found.runs_to_tell:,} runs" if found.runs_to_tell else f"more than {MAX_RUNS:,} runs"
        yield (
            f"{found.runs:,} runs tell a difference of {amount(name, found.detectable, found)} four times in five; "
            f"one of {amount(name, abs(found.mean), found)}, as it was here, would take {needed}"
        )


def worlds_summary(found: dict[str, Any]) -> RenderableType:
    """A row for each world: the figure of each mind, how much that is of the one as taught, and how long runs were."""
    minds, runs = found["minds"], found["runs"]
    places = ["A", "B"] if len(minds) > 1 else ["mean"]
    taught = {each["name"]: figure(each)[0] for each in found["worlds"][0]["minds"]}
    head = ["", *(cell for place in places for cell in (place, "share", "time"))]
    return Group(
        Text.assemble((found["task"], "bold"), f" in changed worlds, {runs:,} run{'s' * (runs != 1)} of each"),
        *(
            Text(f"  {place}{mind['file']} with {mind['master']} in charge: {taught[mind['name']]}")
            for place, mind in zip(("A  ", "B  ") if len(minds) > 1 else ("",), minds, strict=True)
        ),
        "",
        aligned([[*_world_row(row, [*taught])] for row in found["worlds"]], (0,), head),
        "",
        Text("share: of the mean as taught; time: of the task's ticks; ± is one standard error", "dim"),
        *_broken_elsewhere(("as taught", "at worst", "in"), [*_promised_in_worlds(found)]),
    )


def _promised_in_worlds(found: dict[str, Any]) -> Iterator[Elsewhere]:
    """Each mind with its promises as taught, and in each other world."""
    for place, mind in zip("AB", found["minds"], strict=False):
        there = {
            row["world"]: each.get("promises", ())
            for row in found["worlds"]
            for each in row["minds"]
            if each["name"] == mind["name"]
        }
        yield f"{place} " * (len(found["minds"]) > 1), there.pop(found["worlds"][0]["world"]), there


def _world_row(row: dict[str, Any], minds: Sequence[str]) -> Iterator[str | Text]:
    """The name of a world, and the cells of each mind; – where it has no such world, or no share."""
    yield shortened(row["world"], WORLD_COLUMNS // len(minds))
    there = {each["name"]: each for each in row["minds"]}
    for found in map(there.get, minds):
        if found is None:
            yield from "–––"
            continue
        name, mean, error = figure(found)
        share, spread = found["of_as_taught"], f" ± {_figure(name, error)}" if error else ""
        yield _figure(name, mean) + spread
        yield from ("–" if share is None else f"{share:.0%}", f"{found['runtime_mean']:.0%}")


def credit_summary(found: dict[str, Any], credited: Mapping[str, PairedDifference]) -> RenderableType:
    """A row for each skill: the figure without what it is or learnt, and how much more the whole mind has."""
    name, runs, is_silent = found["figure"], found["runs"], found["left"] == "without"
    head = found["left"], "mean", "credit", f"{PERCENT} confidence"
    means = {each["skill"]: _figure(*figure(each)[:2]) for each in found["skills"]}
    return Group(
        _title(found).append(f", {runs:,} run{'s' * (runs != 1)} from seed {found['seed']}"),
        f"{_figure(*figure(found)[:2])} {name}",
        "",
        aligned([(skill, means[skill], *_difference(name, each)) for skill, each in credited.items()], (0,), head),
        "",
        Text("credit: how much more the whole mind has, on the same layouts", "dim"),
        *_broken_elsewhere(
            ("whole", "at worst", "without" if is_silent else "as there"),
            [("", found.get("promises", ()), {each["skill"]: each.get("promises", ()) for each in found["skills"]})],
            is_silent,
        ),
    )


def shortened(text: str, columns: int) -> str:
    """A text cut to so many columns of a terminal."""
    return text if cell_len(text) <= columns else f"{set_cell_size(text, columns - 1)}…"


def aligned(rows: Iterable[Row], left: Collection[int], head: Sequence[str] = ()) -> Text:
    """A line for each row, two blanks between its columns; those in `left` are set to the left, others to the right.

    Above them, dim, stands the `head`.
    """
    cells = [[Text(cell) if isinstance(cell, str) else cell.copy() for cell in row] for row in rows]
    cells[:0] = [[Text(cell, "dim") for cell in head]] if head else []
    for number, column in enumerate(zip(*cells, strict=True)):
        width = max(cell.cell_len for cell in column)
        for cell in column:
            cell.align("left" if number in left else "right", width)
    lines = [Text("  ").join(row) for row in cells]
    for line in lines:
        line.rstrip()
    return Text("\n").join(lines)
