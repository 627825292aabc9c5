"""An answer for reading: the command, and the paths that made it."""

from collections.abc import Iterator, Sequence
from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.shares import MAX_COUNTED_PATHS
from mindlang.compiler.diagnostic import listed
from mindlang.number_format import score

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
        yield Text(f"{each['share']:9.4f}  {_bar(each['part']):<14}{each['value']:8.4f}  {_path(each['path'])}")
        if each["reads"]:
            yield Text(_cut(f"{'':11}read {_reads(each['reads'])}"), "dim")
    for number, text in _others(found):
        yield Text(f"{number:9.4f}  {text}")
    yield Text(f"{_command(found)}  {_total(found)}", "bold")
    for note in _notes(found):
        yield Text(note, "dim")


def _command(found: dict[str, Any]) -> str:
    return f"{'–':>9}" if found["command"] is None else f"{found['command']:9.4f}"


def _bar(part: float) -> str:
    return f"{part:6.1%} " + "█" * round(part * BAR_CHARACTERS)


def _path(names: Sequence[str]) -> str:
    """The skills of a path; of one that is too long for a line those at both ends."""
    skills = [*names[:-1]] or [*names]
    kept, room = len(skills), LINE_CHARACTERS - PATH_COLUMN
    while (text := _shortened(skills, kept)) and len(text) > room and kept > 2:
        kept -= 1
    return text


def _shortened(skills: Sequence[str], kept: int) -> str:
    """A path in one line, shortened to so many of its skills: the master, and the last ones."""
    if kept == len(skills):
        return " → ".join(skills)
    return " → ".join([skills[0], f"{len(skills) - kept} more", *skills[len(skills) - kept + 1 :]])


def _reads(reads: dict[str, list[float | None]]) -> str:
    return ", ".join(f"{name} {_values(values)}" for name, values in reads.items())


def _values(values: Sequence[float | None]) -> str:
    few = ["no number" if value is None else f"{value:.3g}" for value in values[:MAX_NAMED_READINGS]]
    return " ".join(few) + " …" * (len(values) > MAX_NAMED_READINGS)


def _cut(line: str) -> str:
    return line if len(line) <= LINE_CHARACTERS else line[: LINE_CHARACTERS - 1] + "…"


def _others(found: dict[str, Any]) -> Iterator[tuple[float, str]]:
    """What of the command no named path has made."""
    rest, ticks = found["rest"], _tick_count(found)
    if rest["paths"]:
        larger = "" if found["are_largest"] else ", of which some may be larger"
        yield rest["share"], f"{rest['part']:6.1%} over {_many(rest['paths'])} more{larger}"
    if found["undriven"] and found["kind"] == "actuator":
        when = "" if ticks == 1 else f" in {found['undriven']:,} of {ticks:,} ticks"
        yield found["neutral"], f"nothing influenced it{when}: its neutral"
    if abs(found["rounding"]) > GAIN_NOTED:
        yield found["rounding"], "rounding of the engine's sums"


def _many(paths: int) -> str:
    if paths >= MAX_COUNTED_PATHS:
        return "10^15 paths or"
    return "1 path" if paths == 1 else f"{paths:,} paths"


def _total(found: dict[str, Any]) -> str:
    mean = "" if _tick_count(found) == 1 else ", in the mean"
    if found["kind"] == "memory" and 0 < found["undriven"] < _tick_count(found):
        mean += " where it was sent one"
    if found["kind"] == "skill":
        return f"influence on {found['of']}{mean}"
    return f"command to {found['of']}{mean}; influence {found['influence']:.4g} in all"


def _notes(found: dict[str, Any]) -> Iterator[str]:
    ticks = _tick_count(found)
    if found["undriven"] and found["kind"] != "actuator":
        nothing = "nothing influenced it" if found["kind"] == "skill" else "nothing drove it"
        yield nothing if ticks == 1 else f"{nothing} in {found['undriven']:,} of {ticks:,} ticks"
    if silent := found["silent"]:
        more = len(silent) - MAX_NAMED_SKILLS
        names = silent if more <= 1 else [*silent[:MAX_NAMED_SKILLS], f"{more:,} more"]
        yield f"sent it nothing: {listed(names, 'and')}"
    if found["kind"] == "actuator" and abs(found["acted"] - found["command"]) > GAIN_NOTED:
        yield _acted(found)


def _acted(found: dict[str, Any]) -> str:
    ticks, stopped = _tick_count(found), found["stopped"]
    mean = "" if ticks == 1 else ", in the mean"
    if "recording" not in found:
        return f"what reached it then is {found['acted']:.4f}{mean}: its commands act later"
    often = f" in {stopped:,} of {ticks:,} ticks" if ticks > 1 else ""
    why = f": the robot was stopped{often}" if stopped else ""
    return f"what was sent to the guardian is {found['acted']:.4f}{mean}{why}"


def _tick_count(found: dict[str, Any]) -> int:
    first, last = found["ticks"]
    return int(last - first + 1)
