"""Files of layouts on which a lesson teaches a share of its runs: the seeds of these, one a line."""

from collections.abc import Sequence
from pathlib import Path

from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import HardLayouts
from mindrun.graph.validate import is_layout
from mindrun.kinds.learners import SHARE

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.resolve.kinds import once
from mindlang.compiler.resolve.maps import path_inside, why_unread
from mindlang.compiler.resolve.quantities import SHAPES
from mindlang.compiler.source import MAX_SOURCE_BYTES, decode_source
from mindlang.compiler.syntax import Argument, Text

HARD, OF = "hard", "of"
FILE_HINT = 'Write hard 25% of "hard.seeds"; mindc falsify --write hard.seeds makes the file.'
MAX_SEEDS = 10_000


def hard_layouts(written: Sequence[Argument], root: Path, findings: Findings) -> HardLayouts | None:
    """The layouts of `hard 25% of "hard.seeds"` in a lesson; None where none are said, or after reporting why not."""
    share = once(HARD, written, findings)
    if share is None:
        return None
    number = SHAPES["one"](share.value, SHARE, findings)
    file = once(OF, written, findings)
    if file is None or not isinstance(file.value, Text):
        span = file.value.span if file else share.span
        findings.error("not-a-file", span, "Behind a share of hard layouts stands the file that has them.", FILE_HINT)
        return None
    seeds = _seeds(file.value, root, findings)
    return HardLayouts(number, seeds) if number is not None and seeds else None


def _seeds(file: Text, root: Path, findings: Findings) -> tuple[str, ...]:
    """The seeds in a file, each once, the least first; empty after reporting why there are none."""
    hint = "Layouts are in the folder of the mind or below it; the path is relative to the file in which it stands."
    if (path := path_inside(file, root, hint, findings)) is None:
        return ()
    try:
        text = decode_source(read_regular(path, MAX_SOURCE_BYTES + 1))
    except (OSError, ValueError, RuntimeError) as error:
        findings.error("unreadable-layouts", file.span, f"{file.text} {why_unread(error)}.", FILE_HINT)
        return ()
    lines = {number: line.partition("#")[0].strip() for number, line in enumerate(text.split("\n"), 1)}
    seeds = {number: seed for number, seed in lines.items() if seed}
    wrong = next((number for number, seed in seeds.items() if not is_layout(seed)), None)
    if wrong is not None:
        why, hint = f"has no seed in line {wrong}: {seeds[wrong]!r:.40}", "A seed a line, a whole number below 2^64."
    elif not 1 <= len(seeds) <= MAX_SEEDS:
        why, hint = f"has {len(seeds):,} seeds", f"It has from 1 to {MAX_SEEDS:,}. {FILE_HINT}"
    else:
        return tuple(map(str, sorted({*map(int, seeds.values())})))
    findings.error("unreadable-layouts", file.span, f"{file.text} {why}.", hint)
    return ()
