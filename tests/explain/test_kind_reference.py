"""docs/kinds.md has every kind with all of its arguments, as the kinds themselves say them."""

import os

import pytest
from mindrun.registry import arguments, kinds

from mindlang.explaining.kind_reference import NOUNS, all_kinds
from tests.project.sources import ROOT

PUBLISHED = ROOT / "docs" / "kinds.md"


def test_what_is_published_is_what_the_kinds_say() -> None:
    if os.environ.get("UPDATE"):
        PUBLISHED.write_text(all_kinds(), encoding="utf-8")
    assert PUBLISHED.read_text(encoding="utf-8") == all_kinds()


@pytest.mark.parametrize("noun", NOUNS)
def test_every_kind_and_every_argument_is_there(noun: str) -> None:
    chapter = all_kinds().split(f"\n## {NOUNS[noun]}\n")[1].split("\n## ")[0]
    pages = {page.partition("`")[0]: page for page in chapter.split("\n### `")[1:]}
    assert pages
    assert set(pages) == set(kinds(noun))
    for name, cls in kinds(noun).items():
        assert all(f"| `{each.key}` |" in pages[name] for each in arguments(cls))
