"""What is offered where, without a client."""

from pathlib import Path

import pytest

from mindlang.server.completing import complete
from mindlang.server.hovering import hover
from mindlang.server.workspace import Workspace
from tests.language.examples import TOUR

TEXT = TOUR.read_text(encoding="utf-8")
BELOW_AVOID = "skill Fetch"
BELOW_WORK = "curriculum Tour"
BELOW_QUICK = "\n\n\n\n"
CASES = [  # where the line is put, the line with | for the cursor, what must be offered, what must not
    (BELOW_AVOID, "|", "reads drives influences stays skill sensor tick", "contains teaches"),
    (BELOW_AVOID, "  re|", "reads", "rewards"),
    (BELOW_AVOID, "  reads |", "parcel_bearing mood", "moving left_wheel"),
    (BELOW_AVOID, "  drives |", "claw neck mood", "left_wheel eyes"),
    (BELOW_AVOID, "  drives claw |", "at", "reads"),
    (BELOW_AVOID, "  drives claw at |", "moving pulse", "parcel_bearing"),
    (BELOW_AVOID, "  drives claw at 1 - (|", "moving pulse", "parcel_bearing"),
    (BELOW_AVOID, "  influences |", "Fetch Live", "Avoid eyes"),
    (BELOW_AVOID, "  stays |", "frozen", "moving"),
    (BELOW_AVOID, "skill X |", "is", "in"),
    (BELOW_AVOID, "task X |", "in is", "at"),
    (BELOW_AVOID, "skill X is |", "mlp ctrnn elman gru neat rule procedure", "wheel"),
    (BELOW_AVOID, "skill X is |", "like", "wheel"),
    (BELOW_AVOID, "skill X is like |", "Avoid Fetch", "X eyes"),
    (BELOW_AVOID, "  reads parcel_bearing |", "", "for"),
    (BELOW_AVOID, "skill X is mlp |", "hidden width", "mlp where"),
    (BELOW_AVOID, "skill GoN is rule |", "where", "mlp"),
    (BELOW_AVOID, "skill X is mlp hidden 2 |", "width", "hidden"),
    (BELOW_AVOID, "skill X is elman |", "width", "hidden"),
    (BELOW_AVOID, "sensor x is |", "compass bearing", "elman"),
    (BELOW_AVOID, "sensor x is compass |", "dead_zone noise lost every delay", "of range"),
    (BELOW_AVOID, "skill X is procedure from |", "tour.toward", "width"),
    (BELOW_AVOID, "sensor x is range_finder at 0 90 |", "deg range dead_zone", "at"),
    (BELOW_AVOID, "sensor x is range_finder at 0 to 90 |", "by", "to"),
    (BELOW_AVOID, "sensor x is order 1 to 7 |", "neutral every timeout", "by"),
    (BELOW_WORK, "  contains x is obstacle size 3 to 4 |", "count away", "by"),
    (BELOW_WORK, "  contains x is item away 3 to 4 |", "size", "by"),
    (BELOW_AVOID, "sensor x is bearing of |", "parcel depot charger rock wall", "eyes"),
    (BELOW_AVOID, "sensor x is light of |", "parcel depot charger", "rock eyes"),
    (BELOW_AVOID, "sensor x is contact of |", "parcel", "depot"),
    (BELOW_AVOID, "sensor x is derivative of |", "eyes mood", "parcel"),
    (BELOW_AVOID, "actuator x is wheel side |", "left right", "neutral"),
    (BELOW_AVOID, "sensor x is observation |", "", "range observation"),
    (BELOW_AVOID, "sensor x is observation image 3 |", "range noise delay", "observation part"),
    (BELOW_AVOID, "actuator x is choice 2 |", "neutral delay", "choice part"),
    (BELOW_WORK, "  ends on its |", "end", "reward"),
    (BELOW_WORK, "  rewards its |", "reward", "end"),
    (BELOW_WORK, "  rewards 1 on its |", "end", "reward"),
    (BELOW_AVOID, "task X in |", "gymnasium arena", "mlp"),
    (BELOW_AVOID, "task X in gymnasium CartPole-v1 |", "", "size gymnasium"),
    (BELOW_AVOID, 'use "|', "parts.mind", "tour.mind"),
    (BELOW_AVOID, "master |", "Live", "eyes"),
    (BELOW_AVOID, "tick 1/50 |", "s", "deg"),
    (BELOW_AVOID, "  reads eyes # see |", "", "moving"),
    (BELOW_WORK, "  |", "contains lasts ends rewards counts", "reads"),
    (BELOW_WORK, "  contains x is |", "item zone obstacle power", "mlp"),
    (BELOW_WORK, "  contains x is item size 3 |", "to away", "by"),
    (BELOW_WORK, "  contains x is item size 3 to 1 |", "by", "to"),
    (BELOW_WORK, "  contains x is item |", "reached delivered size count at", "grid"),
    (BELOW_WORK, "  contains x is zone size 3 |", "reached away", "delivered"),
    (BELOW_WORK, "  contains x is item reached |", "stays moves vanishes", "size"),
    (BELOW_WORK, "  contains x is item reached stays |", "delivered", "reached"),
    (BELOW_WORK, "  lasts 5 |", "ticks s", "deg"),
    (BELOW_WORK, "  ends |", "on", ""),
    (BELOW_WORK, "  ends on |", "collision exhaustion", "progress"),
    (BELOW_WORK, "  counts reach of |", "parcel depot", "wall"),
    (BELOW_WORK, "  rewards 2 * |", "progress forward holding", "reach"),
    (BELOW_WORK, "  rewards 2 * progress |", "toward", "beyond"),
    (BELOW_WORK, "  rewards 2 * progress toward |", "parcel", "on"),
    (BELOW_WORK, "  rewards 2 * progress toward parcel |", "on", "toward"),
    (BELOW_WORK, "  rewards 2 * progress toward parcel per |", "tick", "on"),
    (BELOW_WORK, "  rewards 2 * p per tick for |", "each", "tick"),
    (BELOW_WORK, "  rewards 2 * p per tick for each p in |", "eyes", "parcel"),
    (BELOW_WORK, "  rewards 2 per tick when |", "holding forward", "tick"),
    (BELOW_WORK, "  rewards 2 on |", "delivery", "forward"),
    (BELOW_WORK, "  rewards 2 on delivery of |", "parcel", "depot"),
    (BELOW_QUICK, "  teaches |", "Avoid Live", "Tour"),
    (BELOW_QUICK, "  teaches Avoid on |", "Work", "Live"),
    (BELOW_QUICK, "  teaches Avoid on Work |", "under for", "on"),
    (BELOW_QUICK, "  teaches Avoid on Work under |", "Live", "eyes"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 |", "generations", "s"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations |", "population octaves", "is"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations from |", "scratch", "population"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations |", "using", "evolution_strategy"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations using |", "genetic evolution_strategy", "population"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations using evolution_strategy |", "mutation", "elite using"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations needs 3 |", "reach collision", "score"),
    (BELOW_QUICK, "  teaches Avoid on Work until 3 reach |", "of for", "population"),
    (BELOW_QUICK, "  teaches Avoid on Work until 3 reach of |", "parcel", "score"),
    ("skill Avoid", "sensor any_way is bearing of parcel |", "or range", "and"),
    ("skill Avoid", "sensor any_way is bearing of parcel or |", "depot", "eyes"),
    (BELOW_QUICK, "  teaches Avoid on Work until |", "score success", "reach"),
    (BELOW_QUICK, "  teaches Avoid on Work for 9 generations needs |", "score success", "reach"),
    (BELOW_AVOID, "  drives claw |", "at when", "cuts otherwise"),
    (BELOW_AVOID, "  influences Fetch |", "over at when", "otherwise"),
    (BELOW_AVOID, "  influences Fetch over |", "claw left_wheel", "moving"),
    (BELOW_AVOID, "  influences Fetch over claw |", "and at when", "over"),
    (BELOW_AVOID, "  influences Fetch over claw and |", "left_wheel", "claw"),
    (BELOW_AVOID, "  chooses |", "one", "frozen"),
    (BELOW_AVOID, "  drives claw at moving |", "when", "at moving otherwise"),
    (BELOW_AVOID, "  drives claw when |", "moving pulse", "parcel_bearing when"),
    (BELOW_AVOID, "  drives claw when moving |", "", "otherwise"),
    (BELOW_AVOID, "  drives claw when moving > 0.5 |", "and or otherwise", "when"),
    (BELOW_AVOID, "  drives claw when moving > 0.5 and |", "moving pulse", "otherwise"),
    (BELOW_AVOID, "  drives claw when moving > 0.5 otherwise |", "moving pulse", "otherwise"),
    (BELOW_AVOID, "  drives claw at least |", "of", "moving"),
    (BELOW_AVOID, "  drives claw at least of |", "moving pulse", "when"),
    (BELOW_AVOID, "  drives claw at least of moving |", "moving pulse", "of when"),
    (BELOW_AVOID, "  drives claw at least of moving pulse |", "moving pulse when", "of"),
    (BELOW_AVOID, "  influences Fetch cuts |", "below", "at"),
    (BELOW_AVOID, "  influences Fetch at 1 cuts below 5 |", "%", "below"),
    (BELOW_WORK, "  |", "starts varies fails succeeds", "reads"),
    (BELOW_WORK, "  contains cat is walker seeks |", "robot parcel", "left_wheel"),
    (BELOW_WORK, "  contains rival is box flees |", "robot parcel", "left_wheel"),
    (BELOW_WORK, "  contains rival is box |", "seeks thrust", "along"),
    (BELOW_WORK, "  ends |", "when", ""),
    (BELOW_WORK, "  succeeds |", "on when", ""),
    (BELOW_WORK, "  succeeds on |", "collision delivery", "forward"),
    (BELOW_WORK, "  succeeds on 5 |", "collision delivery", "forward"),
    (BELOW_WORK, "  succeeds on 5 delivery of |", "parcel", "depot"),
    (BELOW_WORK, "  succeeds on 5 delivery of parcel |", "to within", "when of"),
    (BELOW_WORK, "  succeeds on 5 delivery of parcel within 3 |", "s ticks of", "deg within"),
    (BELOW_WORK, "  counts collision within 3 s of |", "reach delivery", "parcel progress"),
    (BELOW_WORK, "  counts collision within 3 s of reach of |", "parcel depot", "eyes"),
    (BELOW_WORK, "  rewards progress toward parcel |", "on", "within"),
    (BELOW_WORK, "  ends when |", "holding left_wheel forward", "on"),
    (BELOW_WORK, "  ends when holding < 0.5 |", "and or", "otherwise"),
    (BELOW_WORK, "  starts |", "at facing", "on"),
    (BELOW_WORK, "  starts at -5 3 |", "facing", "deg"),
    (BELOW_WORK, "  starts at -5 3 facing 9 |", "deg", "facing"),
    (BELOW_WORK, "  draws |", "", "parcel eyes"),
    (BELOW_WORK, "  draws side from 0 |", "to", "by deg"),
    (BELOW_WORK, "  draws side from 0 1\n  contains gem is item at 3 4 |", "or count reached when", "at"),
    (BELOW_WORK, "  draws side from 0 1\n  contains gem is item at +|", "side", "eyes left_wheel"),
    (BELOW_WORK, "  draws side from 0 1\n  contains gem is item when |", "side", "eyes left_wheel"),
    (BELOW_WORK, "  draws side from 0 1\n  rewards |", "side holding", ""),
    (BELOW_WORK, "  contains gem is item within |", "depot", "parcel"),
    (BELOW_WORK, "  contains cat is walker along 0 0 to 5 5 from |", "anywhere start", "depot"),
    (BELOW_WORK, "  varies |", "thrust noise density", "neutral parcel"),
    (BELOW_WORK, "  varies thrust |", "of", "thrust"),
    (BELOW_WORK, "  varies thrust of |", "left_wheel", "eyes claw"),
    (BELOW_WORK, "  varies noise of eyes 5 |", "% to", "deg"),
    (BELOW_WORK, "  varies noise of eyes 5% to 9 |", "%", "to"),
    (BELOW_WORK, "  fails |", "left_wheel claw", "eyes"),
    (BELOW_WORK, "  fails claw 1 |", "% per", "to"),
    (BELOW_WORK, "  fails claw 1% per |", "s tick", "per"),
]


def offered(place: str, line: str) -> dict[str, str]:
    at = TEXT.index(place) if place in TEXT else len(TEXT)
    text = f"{TEXT[:at]}{line.replace('|', '')}\n{TEXT[at:]}"
    workspace = Workspace({TOUR: text})
    offset = at + line.index("|")
    found = complete(workspace.view(TOUR), TOUR, text, offset)
    assert text[found.start : offset] == line[line.index("|") - (offset - found.start) : line.index("|")]
    return {offer.label: offer.text for offer in found.offers}


@pytest.mark.parametrize(("place", "line", "wanted", "unwanted"), CASES, ids=[case[1] for case in CASES])
def test_offers(place, line, wanted, unwanted):
    found = offered(place, line)
    assert set(wanted.split()) <= set(found)
    if wanted != "on":
        assert not set(unwanted.split()) & set(found)
    assert wanted or not found


def test_kinds_and_arguments_are_explained():
    assert "perceptron" in offered(BELOW_AVOID, "skill X is |")["mlp"]
    assert "default: 12" in offered(BELOW_AVOID, "sensor x is range_finder |")["range"]


def test_a_title_with_a_plus_is_replaced_as_a_whole(tmp_path: Path):
    path = tmp_path / "a.mind"
    text = "skill Go+Avoid is rule\nskill X is rule\n  influences Go+Av"
    assert complete(Workspace({path: text}).view(path), path, text, len(text)).start == text.index("Go+Av", 20)


def test_below_a_skill_that_is_like_another_stand_the_inputs_of_that_one() -> None:
    above = "sensor a is battery\nsensor b is battery\nskill Go is mlp\n  reads a\nskill Back is like Go\n"
    again = above + "  reads b for a\nskill Again is like Back\n"
    for text, offered in (
        (above + "  reads b ", "for"),
        (above + "  reads b for ", "a"),
        (again + "  reads a for ", "b"),
    ):
        path = Path("mind.mind").resolve()
        found = complete(Workspace({path: text}).view(path), path, text, len(text))
        assert [offer.label for offer in found.offers] == [offered]


def test_a_lesson_may_begin_from_nothing_or_from_a_skill() -> None:
    text = "skill Go is mlp\ncurriculum School is genetic\n  teaches Go on Roam for 10 generations from "
    path = Path("mind.mind").resolve()
    found = complete(Workspace({path: text}).view(path), path, text, len(text))
    assert [offer.label for offer in found.offers] == ["scratch", "Go"]


@pytest.mark.parametrize(
    ("place", "line", "said"),
    [
        (BELOW_AVOID, "  drives claw at least |of moving pulse", "The least of several"),
        (BELOW_AVOID, "  drives claw at great|est of moving pulse", "The greatest of several"),
        (BELOW_AVOID, "  drives claw at 1 when moving > 0.5 other|wise 0", "does not hold"),
        (BELOW_AVOID, "  influences Fetch cuts be|low 5%", "smaller than this is none"),
        (BELOW_WORK, "  succe|eds on 5 delivery of parcel", "as a success"),
        (BELOW_WORK, "  starts at 0 0 fac|ing 90 deg", "when it starts"),
        (BELOW_WORK, "  var|ies thrust of left_wheel 60 to 90", "drawn anew for each run"),
        (BELOW_WORK, "  dr|aws side from 0 1", "A number of the run"),
        (BELOW_WORK, "  draws side from 0 1\n  contains gem is item at si|de 3", "draws side from 0 1"),
        (BELOW_WORK, "  contains gem is item with|in depot", "in which its middle is placed"),
        (BELOW_WORK, "  varies thr|ust of left_wheel 60 to 90", "`thrust`"),
        (BELOW_WORK, "  varies noise of ey|es 0 to 5%", "range_finder"),
        (BELOW_WORK, "  fa|ils claw 1% per s", "stuck at neutral"),
        (BELOW_WORK, "  fails claw 1% p|er s", "The time that a rate is for"),
    ],
)
def test_words_are_explained_where_they_stand(place: str, line: str, said: str) -> None:
    at = TEXT.index(place)
    text = f"{TEXT[:at]}{line.replace('|', '')}\n{TEXT[at:]}"
    found = hover(Workspace({TOUR: text}).view(TOUR), TOUR, at + line.index("|"))
    assert found
    assert said in found.text


def test_the_environments_of_gymnasium_are_offered() -> None:
    pytest.importorskip("gymnasium")
    path, text = Path("/nowhere/a.mind"), "task Land in gymnasium "
    labels = [offer.label for offer in complete(Workspace({path: text}).view(path), path, text, len(text)).offers]
    assert {"CartPole-v1", "LunarLanderContinuous-v3"} <= {*labels}
