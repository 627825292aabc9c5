"""What stands where on the site: a page that is in none of these lists is an error when it is built."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

INDEX, DECISIONS = "docs/index", "docs/decisions/README"
# In the order in which a newcomer meets what they are about.
SUBJECTS = ("file", "values", "robot", "skills", "worlds", "tasks", "environments", "curricula")
LANGUAGE = ("language", *(f"language/{subject}" for subject in SUBJECTS))
# Under each heading the pages that there are, in this order, as they are seen from the page that leads to them.
PAGES: Mapping[str, Mapping[str, Sequence[str]]] = {
    INDEX: {
        "Begin": ["../README", "install", "new", "tutorial", "tour", "guides/*"],
        "Reference": [*LANGUAGE, "kinds", "words", "codes", "commands", "lint", "edits", "python*", "glossary"],
        "Teach": ["learning", "several-robots", "showing", "propose", "audit", "falsify"],
        "Train and measure": ["lifelong", "logs", "cluster", "locks", "weights", "gymnasium"],
        "See and ask": ["view", "why", "whatif", "breakpoints", "proofs"],
        "On the robot": ["robot", "robot-yaml", "drivers", "safety", "deploy"],
        "Examples": ["../examples/*/README", "../examples/*/RESULTS"],
        "Around it": ["editors", "playground", "versions", "../CHANGELOG"],
        "How it is made": ["design", "decisions/README", "../CONTRIBUTING"],
    },
    DECISIONS: {"Decisions": ["[!R]*"]},
}
# The page that a code host shows first has the name of the whole, as has the index.
TITLES: Mapping[str, str] = {"README": "Install, and first steps"}


def with_contents(page: str, text: str, root: Path) -> str:
    """The text of a page with the lists of those that it leads to, as a code host need not see them."""
    return "\n".join([text, *_lists(page, root)])


def _lists(page: str, root: Path) -> Iterator[str]:
    folder = (root / page).parent
    for heading, patterns in PAGES.get(page, {}).items():
        found = [path for pattern in patterns for path in sorted(folder.glob(f"{pattern}.md"))]
        entries = [path.resolve().relative_to(root.resolve()).with_suffix("").as_posix() for path in found]
        hidden = ":hidden:\n" if page == DECISIONS else ""  # it lists them itself, with a sentence each
        yield f"```{{toctree}}\n:caption: {heading}\n{hidden}\n" + "".join(map(_entry, entries)) + "```\n"


def _entry(page: str) -> str:
    return f"{TITLES[page]} </{page}>\n" if page in TITLES else f"/{page}\n"
