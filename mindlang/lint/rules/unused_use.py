"""A file that is used, but nothing of it is.

Nobody names a sensor, a memory or a skill of it, and it has nothing else to give: no body or actuator, no task or
curriculum, no tick, no lock with weights.
"""

from collections.abc import Iterable
from pathlib import Path

from networkx import DiGraph

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.hierarchy import below
from mindlang.compiler.syntax import Declaration, File, Tick, Use
from mindlang.editing.insertion import first_line, remove_lines
from mindlang.lint.study import Finding, Found, Study
from mindlang.lock import lock_path

PASSIVE = {"sensor", "memory", "skill"}
PARTS = "-- parts.mind --\ntick 1/60 s\nsensor eye is range_finder at 0 deg\n"
GOOD = (f'use "parts.mind"\nskill Go is rule\n  reads eye\n  drives left_wheel at eye\n{PARTS}',)
BAD = (f'use "parts.mind"\nskill Go is rule\n  drives left_wheel at 1\n{PARTS}',)


def check(study: Study) -> Found:
    """Lines of the main file whose files, as far as no other line brings them, only declare what nobody names."""
    main, *others = study.mind.files
    known = {file.source.path: file for file in others}
    uses = [setting for setting in main.settings if isinstance(setting, Use)]
    brings = _brings(known)
    reach = {id(use): below(brings, {path} & known.keys()) for use in uses for path in [_path(use)]}
    for use in uses:
        shared = {path for other in uses if other is not use for path in reach[id(other)]}
        brought = [known[path] for path in reach[id(use)] - shared]
        if brought and not _is_used(study, brought):
            line = first_line(use.span)
            fix = Fix("Remove the line", (remove_lines(line, line),))
            hint = "Take the line out, or use something of it."
            yield Finding(use.span, f"Nothing of {use.path} is used.", hint, fix=fix)


def _path(use: Use) -> Path:
    return (use.span.source.folder / use.path).resolve()


def _brings(known: dict[Path, File]) -> DiGraph:
    """The used files, an edge to each that one of them uses."""
    graph = DiGraph()
    for path, file in known.items():
        graph.add_node(path)
        used = (_path(setting) for setting in file.settings if isinstance(setting, Use))
        graph.add_edges_from((path, other) for other in used if other in known)
    return graph


def _is_used(study: Study, files: Iterable[File]) -> bool:
    sources = {id(file.source) for file in files}
    others = [file for file in study.mind.files if id(file.source) not in sources]
    nouns = {declaration.header.noun.text for file in files for declaration in file.declarations}
    if study.is_exhausted and any(_is_battery(study, each) for file in files for each in file.declarations):
        return True
    if nouns - PASSIVE or any(lock_path(file.source.path).exists() for file in files):
        return True
    if not any(isinstance(setting, Tick) for file in others for setting in file.settings):
        return True
    named = {(each.noun, each.name.text) for each in study.mentions if id(each.name.span.source) not in sources}
    own = {(each.header.noun.text, each.header.name.text) for file in files for each in file.declarations}
    return not named.isdisjoint(own)


def _is_battery(study: Study, declaration: Declaration) -> bool:
    header = declaration.header
    return header.noun.text == "sensor" and study.sensors[header.name.text].battery is not None
