"""Tables 1 to 3 and Figures 11 to 15 of the paper from trained weights and logs: python examples/collect/paper.

Writes RESULTS.md and figures/ into --out. The weights, locks and logs are those of --folder, where `teach.py` put them.
"""

import argparse
import sys
from pathlib import Path
from string import Template

from figures import draw
from mindrun.errors import MindError
from mindrun.terminal.arguments import MAX_SEED, whole
from plan import PLAN, read_plan
from protocol import FOLDER, TABLES
from tables import attempts, lessons, table

TO = Path("runs/paper")  # where paper-train teaches


def main() -> None:
    """Measure, draw, write."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where the weights and logs lie")
    parser.add_argument("--out", type=Path, default=Path("build/paper"), help="where the report goes")
    parser.add_argument(
        "--runs", type=whole(2, 10_000_000), default=1000, help="layouts that each row of a table is measured on"
    )
    parser.add_argument("--seed", type=whole(0, MAX_SEED), default=1, help="draws the layouts")
    options = parser.parse_args()
    try:
        report(options)
    except MindError as error:
        sys.exit(f"{error}. {error.hint}")


def report(options: argparse.Namespace) -> None:
    """Measure all tables, draw all figures, and write them into the report."""
    plan = read_plan(options.folder)
    options.out.mkdir(parents=True, exist_ok=True)
    parts = {
        name: table(options.folder, of, options.runs, options.seed, say)
        for name, of in zip(("table_1", "table_1_uninterrupted", "table_2", "table_3"), TABLES, strict=True)
    }
    parts |= {
        "attempts": attempts(options.folder, options.seed, say),
        "lessons": lessons(options.folder),
        "figures": draw(options.folder, options.out, say),
        "runs": f"{options.runs:,}",
        "seed": str(options.seed),
        "summary": written(options.folder, "SUMMARY.md"),
        "remarks": written(options.folder, "REMARKS.md"),
        "command": f"make paper-train {plan} TO={TO}" if plan else f"make paper-train TO={TO}",
        "plan": plan.text if plan else "How it was taught is not known here; the last table says what is.",
    }
    text = Template((Path(__file__).parent / "RESULTS.template.md").read_text(encoding="utf-8")).substitute(parts)
    (options.out / "RESULTS.md").write_text(text, encoding="utf-8")
    for title in ("table_1", "table_1_uninterrupted", "table_2", "table_3", "attempts"):
        print(f"\n{title.replace('_', ' ')}\n{parts[title]}")
    say(f"{options.out / 'RESULTS.md'}: all of it")


def written(folder: Path, name: str) -> str:
    """The text that people have written about these weights and logs, beside the plan."""
    try:
        return (folder / PLAN).with_name(name).read_text(encoding="utf-8").rstrip()
    except FileNotFoundError:
        return f"Nobody has written it down: `logs/{name}` is the place."


def say(text: str) -> None:
    """Tell who waits."""
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
