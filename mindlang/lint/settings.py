"""Which lint rules are held in which files, as `mind.toml` and the command line say."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.lint.rules import all_rules


@dataclass(frozen=True, slots=True)
class LintSettings:
    """Rules that are held (all where none is said), those that are not, and by patterns of paths those not held there.

    `wrong` is what is wrong in the file of settings; what is wrong in it does not count.
    """

    folder: Path = Path()
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    per_file: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    wrong: tuple[Diagnostic, ...] = ()

    def codes(self, path: Path, select: Collection[str] = (), ignore: Collection[str] = ()) -> list[str]:
        """The rules that are held in a file: what a command line selects replaces both lists, what it ignores adds."""
        left_out = {*ignore, *(() if select else self.ignore), *self._ignored_in(path)}
        return [code for code in (select or self.select or all_rules()) if code not in left_out]

    def _ignored_in(self, path: Path) -> Iterator[str]:
        """What is not held in a file; a pattern fits its path from the folder of the settings, or its name alone."""
        name = path.relative_to(self.folder).as_posix() if path.is_relative_to(self.folder) else path.name
        for pattern, codes in self.per_file.items():
            if fnmatchcase(name, pattern) or fnmatchcase(path.name, pattern):
                yield from codes
