"""An answer for reading: the command, and the paths that made it."""

from collections.abc import Iterator, Sequence
from typing import Any

from mindrun.graph.draws import drawn_in_words
from mindrun.terminal.tick_count import ticks as in_words
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.shares import MAX_COUNTED_PATHS
from mindlang.compiler.diagnostic import listed
from mindlang.number_format import score
from mindlang.run.summary import shortened

LINE_CHARACTERS = 80
MAX_NAMED_SKILLS = 4  # of those that sent nothing
MAX_NAMED_READINGS = 5  # of one sensor
BAR_CHARACTERS = 5
PATH_COLUMN = 35  # where paths begin
GAIN_NOTED = 1e-6  # by which rounding or a delay changes a command, for it to be said


def answer_text(found: dict[str, Any]) -> RenderableType:
    """An answer, 80 characters wide where names let it."""
    body = _reward_lines(found) if found["kind"] == "reward" else _share_lines(found)
    return Group(_heading(found), "", *body)


def _heading(found: dict[str, Any]) -> Text:
    first, last = found["ticks"]
    seconds = found["seconds_per_tick"]
    when = (
        f"in tick {first:,} ({first * seconds:.2f} s)"
        if first == last
        else f"in ticks {first:,} to {last:,} ({first * seconds:.2f} to {last * seconds:.2f} s)"
    )
    whose = (
        f"{found['recording']}, {found['master']} in charge"
        if "recording" in found
        else f"{found['task']} with {found['master']} in charge, seed {found['seed']}"
        + drawn_in_words(found.get("drawn", {}))
    )
    return Text.assemble((found["of"], "bold"), f" {when}\n", (whose, "dim"))


def _reward_lines(found: dict[str, Any]) -> Iterator[Text]:
    rows = [(score(paid, 6), text) for text, paid in found["by_line"].items()]
    rows.append((score(found["score"], 6), "paid in all"))
    width = max(len(number) for number, _ in rows)
    for number, text in rows:
        yield Text(f"{number:>{width}}  {text}", "bold" if text == rows[-1][1] else "")
    if found["by_event"]:
        happened = ", ".join(f"{times} × {name}" for name, times in found["by_event"].items())
        yield Text(f"\nhappened: {happened}", "dim")


def _share_lines(found: dict[str, Any]) -> Iterator[Text]:
    noun, value = ("influence", "sent") if found["kind"] == "skill" else ("share", "command")
    yield Text(f"{noun:>9}   {'of influence':<13}{value:>8}  path", "dim")
    for each in found["paths"]:
        bar = "█" * round(each["part"] * BAR_CHARACTERS)
        yield Text(f"{each['share']:9.4f}  {each['part']:6.1%} {bar:<7}{each['value']:8.4f}  {_path(each['path'])}")
        if each["reads"]:
            line = f"{'':11}read {', '.join(f'{name} {_values(values)}' for name, values in each['reads'].items())}"
            yield Text(shortened(line, LINE_CHARACTERS), "dim")
    for number, text in _others(found):
        yield Text(f"{number:9.4f}  {text}")
    command = f"{'–':>9}" if found["command"] is None else f"{found['command']:9.4f}"
    yield Text(f"{command}  {_total(found)}", "bold")
    for note in _notes(found):
        yield Text(note, "dim")


def _path(names: Sequence[str]) -> str:
    """The skills of a path; of one that is too long for a line the master, and as many of the last as fit."""
    skills = [*names[:-1]] or [*names]
    text = " → ".join(skills)
    for left_out in range(2, len(skills)):
        if len(text) <= LINE_CHARACTERS - PATH_COLUMN:
            break
        text = " → ".join([skills[0], f"{left_out - 1} more", *skills[left_out:]])
    return text


def _values(values: Sequence[float | None]) -> str:
    few = ["no number" if value is None else f"{value:.3g}" for value in values[:MAX_NAMED_READINGS]]
    return " ".join(few) + " …" * (len(values) > MAX_NAMED_READINGS)


def _others(found: dict[str, Any]) -> Iterator[tuple[float, str]]:
    """The parts of a command that no named path has made."""
    rest = found["rest"]
    if many := rest["paths"]:
        paths = "10^15 paths or" if many >= MAX_COUNTED_PATHS else "1 path" if many == 1 else f"{many:,} paths"
        larger = "" if found["are_largest"] else ", of which some may be larger"
        yield rest["share"], f"{rest['part']:6.1%} over {paths} more{larger}"
    if found["undriven"] and found["kind"] == "actuator":
        yield found["neutral"], f"nothing influenced it{_often(found, 'undriven')}: its neutral"
    if abs(found["rounding"]) > GAIN_NOTED:
        yield found["rounding"], "rounding of the engine's sums"


def _total(found: dict[str, Any]) -> str:
    mean = _mean(found)
    if found["kind"] == "memory" and 0 < found["undriven"] < _tick_count(found):
        mean += " where it was sent one"
    if found["kind"] == "skill":
        return f"influence on {found['of']}{mean}"
    return f"command to {found['of']}{mean}; influence {found['influence']:.4g} in all"


def _notes(found: dict[str, Any]) -> Iterator[str]:
    if found["undriven"] and found["kind"] != "actuator":
        nothing = "nothing influenced it" if found["kind"] == "skill" else "nothing drove it"
        yield f"{nothing}{_often(found, 'undriven')}"
    if silent := found["silent"]:
        more = len(silent) - MAX_NAMED_SKILLS
        names = silent if more <= 1 else [*silent[:MAX_NAMED_SKILLS], f"{more:,} more"]
        yield f"sent it nothing: {listed(names, 'and')}"
    for each in found.get("promises", ()):
        by = {"it": each["by_skill"], "those above it": each["by_influence"]}
        judged = in_words(each["held"] + sum(by.values()))
        broken = " and ".join(f"by {who} in {many:,}" for who, many in by.items() if many)
        where = f", first in tick {each['first_broken']:,}" if broken else ""
        told = f"broken {broken} of {judged}{where}" if broken else f"held in {judged}"
        yield f"it {each['promise']}\n  {told}"
    if found["kind"] == "actuator" and abs(found["acted"] - found["command"]) > GAIN_NOTED:
        if "recording" in found:
            why = f": the robot was stopped{_often(found, 'stopped')}" if found["stopped"] else ""
            yield f"what was sent to the guardian is {found['acted']:.4f}{_mean(found)}{why}"
        else:
            yield f"what reached it then is {found['acted']:.4f}{_mean(found)}: its commands act later"


def _often(found: dict[str, Any], what: str) -> str:
    ticks = _tick_count(found)
    return "" if ticks == 1 else f" in {found[what]:,} of {ticks:,} ticks"


def _mean(found: dict[str, Any]) -> str:
    return "" if _tick_count(found) == 1 else ", in the mean"


def _tick_count(found: dict[str, Any]) -> int:
    first, last = found["ticks"]
    return int(last - first + 1)
