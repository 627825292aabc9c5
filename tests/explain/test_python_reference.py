"""docs/python-reference.md has every public name of both packages, as their sources say them."""

import os

import mindrun
import pytest

import mindlang
from docs.reference.python_reference import python_reference
from tests.project.sources import ROOT

PUBLISHED = ROOT / "docs" / "python-reference.md"
ABOUT = """\
# Python, name by name

The public names of `mindlang` and `mindrun`, which stay; [python.md](python.md) shows what they are for.

<!-- made from the sources: UPDATE=1 pytest tests/explain/test_python_reference.py -->
"""


def page() -> str:
    """The whole page."""
    lines = [line for package in (mindlang, mindrun) for line in ("", *python_reference(package))]
    return ABOUT + "\n".join(lines).rstrip() + "\n"


def test_what_is_published_is_what_the_sources_say() -> None:
    if os.environ.get("UPDATE"):
        PUBLISHED.write_text(page(), encoding="utf-8")
    assert PUBLISHED.read_text(encoding="utf-8") == page()


@pytest.mark.parametrize("package", [mindlang, mindrun], ids=lambda each: each.__name__)
def test_every_public_name_is_there(package) -> None:
    lines = [*python_reference(package)]
    for name in package.__all__:
        assert f"### `{package.__name__}.{name}`" in lines or name == "VERSION"


def test_a_function_has_its_types_and_what_it_says() -> None:
    text = "\n".join(python_reference(mindlang))
    assert "### `mindlang.load`\n\n```python\ndef load(path: " in text
    assert "#### `Mind.bench`\n\n```python\ndef bench(\n    self,\n    task: str | None=None,\n" in text
    assert "._" not in text.replace("...", "")
