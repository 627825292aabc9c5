"""What is seen of a lesson while it is taught, on terminals of any width."""

from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.kinds.learners import Genetic, run_lengths
from mindrun.train.attempts import Ahead
from mindrun.train.lesson_state import Record
from rich.console import Console

from mindlang.cli._trainer import LessonDisplay, ProgressLine, ProgressText, TimeLeft
from mindlang.number_format import rate

SHOWN = {
    200: "Follow ━━━━━━               attempt 2 of 2, generation 15 of 40, best 6.67, re-evaluated 5.97, "
    "811 k ticks/s, 1 min 45 s left",
    100: "Follow ━━━        attempt 2 of 2, generation 15 of 40, best 6.67, re-evaluated 5.97, 1 min 45 s left",
    80: "Follow ━━╸       attempt 2 of 2, generation 15 of 40, best 6.67, 1 min 45 s left",
    60: "Follow attempt 2 of 2, generation 15 of 40, 1 min 45 s left",
    40: "Follow attempt 2, 15/40, 1 min 45 s left",
}
STANDING = ProgressText(
    "attempt 2 of 2, generation 15 of 40", "attempt 2, 15/40", "best 6.67", "re-evaluated 5.97", "811 k ticks/s",
    "1 min 45 s left",
)  # fmt: skip


def shown(line: ProgressLine, width: int) -> str:
    out = StringIO()
    Console(file=out, width=width, force_terminal=True, color_system=None).print(line)
    return out.getvalue()


def record(attempt: int, generation: int, reevaluated: float | None = None) -> Record:
    return Record(attempt, generation, 6.67, 3.0, reevaluated, None, 1000, 1.0, 0)


@pytest.mark.parametrize("width", SHOWN)
def test_what_a_terminal_shows(width: int) -> None:
    assert shown(ProgressLine("Follow", STANDING, 0.3), width).rstrip() == SHOWN[width]


@given(st.text("Aabc+", min_size=1, max_size=60), st.integers(1, 10**6), st.integers(20, 220), st.booleans())
def test_neither_the_name_nor_the_time_left_is_ever_cut(name: str, best: int, width: int, begun: bool) -> None:
    left = "1 min 45 s left"
    standing = ProgressText("generation 15 of 40", "15/40", f"best {best}", f"re-evaluated {best}", "1 ticks/s", left)
    text = shown(ProgressLine(name, standing if begun else None, 0.5), width)
    assert all(len(line) <= width for line in text.splitlines())
    assert "".join(text.split()).startswith("".join(name.split()))
    assert "".join(text.split()).endswith("1min45sleft" if begun else "thefirstgeneration…")


def test_where_there_are_attempts_the_generation_is_one_of_them() -> None:
    pace = TimeLeft(80, 0.0, attempts=2)
    assert pace.standing(record(2, 2), 42, 1.0).text().startswith("attempt 2 of 2, generation 2 of 40, best 6.67, ")
    assert TimeLeft(80, 0.0).standing(record(1, 42), 42, 1.0).where == "generation 42 of 80"


def test_what_others_have_done_ahead_shortens_the_time_that_is_left() -> None:
    pace = TimeLeft(400, 0.0, attempts=4)
    for generation in range(1, 11):
        alone = pace.standing(record(1, generation), generation, 10.0)
    assert (alone.where, alone.left, alone.rate) == (
        "attempt 1 of 4, generation 10 of 100",
        "6 min 30 s left",
        rate(1000),
    )
    pace.count_ahead(Ahead(3, 30))
    beside = pace.standing(record(1, 11), 11, 11.0)
    assert beside.where == "attempt 1 of 4, generation 11 of 100 and 30 ahead"
    assert beside.left == "1 min 36 s left", "41 generations in 11 s, and 359 to come"
    assert beside.rate == rate(1000 * 41 / 11)
    assert pace.share(11) == 41 / 400


def test_founders_of_those_ahead_have_been_scored() -> None:
    pace = TimeLeft(80, 0.0, attempts=2, first=10.0)
    pace.count_ahead(Ahead(1, 1))
    assert pace.standing(record(1, 1), 1, 20.0).left == "1 min 18 s left", "20 generations' worth in 20 s, 78 to come"


def test_founders_are_as_many_generations_as_they_take() -> None:
    pace = TimeLeft(80, 0.0, attempts=2, first=10.0)
    assert pace.standing(record(1, 1), 1, 10.0).left == "1 min 28 s left", "79 generations and 9 for the next founders"
    assert pace.standing(record(1, 2), 2, 11.0).left == "1 min 27 s left"
    assert pace.standing(record(2, 1), 41, 60.0).left.startswith("1 min 51 s")
    assert TimeLeft(80, 0.0, attempts=2, first=10.0).standing(record(2, 1), 41, 10.0).left == "39 s left"


def test_short_generations_are_worth_as_much_as_their_runs_are_long() -> None:
    pace = TimeLeft(70, 0.0, first=3.0, lengths=run_lengths(Genetic(short=0.25)))
    assert pace.standing(record(1, 1), 1, 3.0).left == "1 min 59 s left", "3 quarters in 3 s; 39, 20 halves, 10 to come"


def test_a_score_is_told_with_the_generation_that_it_is_of() -> None:
    pace = TimeLeft(80, 0.0, attempts=2, reevaluated=(1, 10, 5.97))  # as of a run that goes on
    records = [(1, 11, None), (1, 20, 4.0), (1, 21, None), (2, 1, None), (2, 10, 3.0), (2, 11, None)]
    told = [pace.standing(record(*each), each[1], 1.0) for each in records]
    assert [each.reevaluated for each in told] == [
        "re-evaluated 5.97 in generation 10",
        "re-evaluated 4.00",
        "re-evaluated 4.00 in generation 20",
        "",
        "re-evaluated 3.00",
        "re-evaluated 3.00 in generation 10",
    ]
    assert told[3].text().startswith("attempt 2 of 2, generation 1 of 40, best 6.67, ")
    assert ", , " not in told[3].text()


def test_the_bar_goes_away_and_lines_stay() -> None:
    out = StringIO()
    console = Console(file=out, width=80, force_terminal=True, color_system=None)
    pace = TimeLeft(40, 0.0)
    bar = LessonDisplay(console, "Follow", pace)
    bar.report(pace.standing(record(1, 20), 20, 1.0), 20, 1.0)
    bar.close()
    assert "generation 20 of 40" in out.getvalue()
    assert out.getvalue().endswith("\x1b[1A\x1b[2K")  # one line up, and empty
    out, pace = StringIO(), TimeLeft(40, 0.0)
    lines = LessonDisplay(Console(file=out, width=200), "Follow", pace)
    for each, done, now in ((record(1, 1, 5.0), 1, 0.5), (record(1, 2), 2, 1.0), (record(1, 40), 40, 2.0)):
        lines.report(pace.standing(each, done, now), done, now)
    assert out.getvalue().splitlines() == [
        "Follow: generation 1 of 40, best 6.67, re-evaluated 5.00, 2 k ticks/s, 20 s left",
        "Follow: generation 40 of 40, best 6.67, re-evaluated 5.00 in generation 1, 2 k ticks/s, 0 s left",
    ]
