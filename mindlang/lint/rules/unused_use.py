"""A file that is used, but nothing of it is.

Nobody names a sensor, a memory or a skill of it, and it has nothing else to give: no body or actuator, no task or
curriculum, no tick, no lock with weights.
"""

from collections.abc import Iterable
from pathlib import Path

from networkx import DiGraph

from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.syntax import File, Tick, Use, of_form
from mindlang.lint.study import Finding, Found, Study, removal
from mindlang.lock import lock_path

PASSIVE = {"sensor", "memory", "skill"}
PARTS = "-- parts.mind --\ntick 1/60 s\nsensor eye is range_finder at 0 deg\n"
GOOD = f'use "parts.mind"\nskill Go is rule\n  reads eye\n  drives left_wheel at eye\n{PARTS}'
BAD = f'use "parts.mind"\nskill Go is rule\n  drives left_wheel at 1\n{PARTS}'


def check(study: Study) -> Found:
    """Lines of the main file whose files, as far as no other line brings them, only declare what nobody names."""
    main, *others = study.mind.files
    known = {file.source.path: file for file in others}
    uses = of_form(main.settings, Use)
    used = {path: map(_path, of_form(file.settings, Use)) for path, file in known.items()}
    brings = DiGraph({path: [each for each in paths if each in known] for path, paths in used.items()})
    reach = [with_descendants(brings, {_path(use)} & known.keys()) for use in uses]
    for number, use in enumerate(uses):
        shared = {path for other, paths in enumerate(reach) if other != number for path in paths}
        brought = [known[path] for path in reach[number] - shared]
        if brought and not _is_used(study, brought):
            hint = "Take the line out, or use something of it."
            yield Finding(use.span, f"Nothing of {use.path} is used.", hint, fix=removal(use, is_safe=True))


def _path(use: Use) -> Path:
    return (use.span.source.folder / use.path).resolve()


def _is_used(study: Study, files: Iterable[File]) -> bool:
    sources = {id(file.source) for file in files}
    own = {(each.header.noun.text, each.header.name.text) for file in files for each in file.declarations}
    sensors = [study.sensors[name] for noun, name in own if noun == "sensor"]
    others = (file for file in study.mind.files if id(file.source) not in sources)
    named = {(each.noun, each.name.text) for each in study.mentions if id(each.name.span.source) not in sources}
    return (
        any(noun not in PASSIVE for noun, _ in own)
        or (study.is_exhausted and any(kind.battery for kind in sensors))
        or any(lock_path(file.source.path).exists() for file in files)
        or not any(of_form(file.settings, Tick) for file in others)
        or not named.isdisjoint(own)
    )
