"""The example minds and a helper to compile text."""

from pathlib import Path

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.source import Source

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").rglob("*.mind"))
COLLECT = ROOT / "examples" / "collect" / "collect.mind"
TOUR = ROOT / "examples" / "tour" / "tour.mind"
RIGHT = Path(__file__).parent / "right.mind"


def compiled(text: str) -> Compiled:
    """A text compiled, as if it stood in a file of this folder."""
    return compile_source(Source("text.mind", text, Path(__file__).parent))


def changed(*pairs: tuple[str, str]) -> Compiled:
    """right.mind compiled with some of its text replaced."""
    text = RIGHT.read_text(encoding="utf-8")
    for before, after in pairs:
        assert before in text
        text = text.replace(before, after, 1)
    return compiled(text)


def codes(found: Compiled) -> list[str]:
    """The codes of all diagnostics."""
    return [diagnostic.code for diagnostic in found.diagnostics]
