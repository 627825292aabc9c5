"""How the site is built of docs/, the examples' pages and the changelog: `make docs`, nothing of it from the network.

The folder that Sphinx reads is the repository, so that a link between two pages is the same here and on a code host.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = map(str, (HERE, HERE.parent, HERE.parent / "runtime"))

from contents import with_contents  # noqa: E402
from mind_lexer import MindLexer  # noqa: E402
from sphinx.application import Sphinx  # noqa: E402

project, author = "mind", "the authors of mind"
html_title = "mind"
root_doc = "docs/index"
extensions = ["myst_parser"]
include_patterns = ["README.md", "docs/**.md", "examples/*/*.md", "CHANGELOG.md", "CONTRIBUTING.md"]
exclude_patterns = ["build", "dist", ".venv", "**/node_modules", "**/runs", "**/weights", "**/*.template.md"]

# Every dead link, every heading that is not there and every page that no other leads to is an error (with -W).
nitpicky = True
myst_heading_anchors = 4
myst_enable_extensions = ["html_image"]

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
templates_path = ["_templates"]
html_additional_pages = {"index": "begin.html"}
SIDEBAR = ("brand", "search", "playground", "scroll-start", "navigation", "scroll-end")
html_sidebars = {"**": [f"sidebar/{part}.html" for part in SIDEBAR]}
html_copy_source = html_show_sourcelink = False
html_show_sphinx = html_show_copyright = False
highlight_language = "text"
pygments_style, pygments_dark_style = "friendly", "github-dark"


def setup(app: Sphinx) -> None:
    """Text of the language has the language's colours, every page is in a list, and the playground if it is there."""
    app.add_lexer("mind", MindLexer)
    app.config.html_context["playground"] = (Path(app.outdir) / "playground" / "index.html").exists()
    app.connect("source-read", _add_contents)


def _add_contents(_: Sphinx, page: str, text: list[str]) -> None:
    linked = re.sub(r'(<a href="[^":]+)\.md(?=["#])', r"\1.html", text[0])  # of HTML in a page Sphinx knows no links
    text[0] = with_contents(page, linked, HERE.parent)
