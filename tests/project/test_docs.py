"""The documents: every link leads somewhere; every decision has its page, its figures and its place in the index."""

import re
from pathlib import Path

import pytest

from tests.project.sources import ROOT

DECISIONS = ROOT / "docs" / "decisions"
HEADINGS = ["Context", "Decision", "Measured", "Rejected", "What would change it"]
PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])


def decisions() -> list[Path]:
    """The pages of the decisions, without their index."""
    return sorted(path for path in DECISIONS.glob("*.md") if path.name != "README.md")


def links(page: Path) -> list[str]:
    """The targets of a page's links that are no addresses on the web."""
    return re.findall(r"\]\((?!https?:)([^)\s]+)\)", page.read_text(encoding="utf-8"))


def anchors(page: Path) -> set[str]:
    """The names under which a page's headings can be linked to."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def leads_nowhere(page: Path, link: str) -> bool:
    """Whether a link names no file of the project, or no heading of it."""
    path, _, anchor = link.partition("#")
    target = page.parent / path if path else page
    return not target.exists() or bool(anchor and target.suffix == ".md" and anchor not in anchors(target))


def test_every_link_leads_somewhere() -> None:
    assert [(page.name, link) for page in PAGES for link in links(page) if leads_nowhere(page, link)] == []


@pytest.mark.parametrize("index", [DECISIONS / "README.md", ROOT / "docs" / "design.md"], ids=lambda page: page.name)
def test_every_decision_is_listed_once(index: Path) -> None:
    listed = [(index.parent / link).resolve() for link in links(index)]
    assert sorted(path for path in listed if path.parent == DECISIONS and path.name != "README.md") == decisions()


def test_a_decision_says_why_when_and_what_was_measured() -> None:
    for page in decisions():
        text = page.read_text(encoding="utf-8")
        assert re.match(r"# .+\n\n20\d\d-\d\d-\d\d(, 20\d\d-\d\d-\d\d)*\n", text), page.name
        assert re.findall(r"^## (.+)$", text, re.MULTILINE) == HEADINGS, page.name
        assert all(re.split(r"^## .+$", text, flags=re.MULTILINE)), page.name


def test_what_a_decision_names_is_there() -> None:
    """Tests, benchmarks and modules by their paths; a module may be said without its package."""
    homes = [ROOT, ROOT / "runtime" / "mindrun", ROOT / "mindlang"]
    said = re.compile(r"`(?:python (?:-m )?)?((?:tests|benchmarks|sim|lock)[/.][\w./]+)")
    named = [(page.name, name) for page in decisions() for name in said.findall(page.read_text(encoding="utf-8"))]
    paths = [(page, name if "/" in name else name.replace(".", "/")) for page, name in named]
    assert [
        (page, path)
        for page, path in paths
        if not any((home / path).exists() or (home / f"{path}.py").exists() for home in homes)
    ] == []
