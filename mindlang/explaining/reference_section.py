"""How a kind or a driver stands in a page of reference: its name, what it is, and a table of what it can be told."""

from collections.abc import Iterable, Iterator


def reference_section(name: str, cls: type, of: str, rows: Iterable[tuple[str, str, str]]) -> Iterator[str]:
    """Lines of Markdown; `rows` have what can be told to it, what that is, and what holds if it is not said."""
    yield from (f"### `{name}`", "")
    yield from (line.removeprefix("    ") for line in str(cls.__doc__).strip().splitlines())
    yield ""
    if said := list(rows):
        yield from (f"| of `{of}` | | if it is not said |", "|---|---|---|")
        yield from (f"| `{key}` | {what} | {otherwise} |" for key, what, otherwise in said)
        yield ""
