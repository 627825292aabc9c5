"""Sources that do not fit their environment, where Gymnasium can be asked: one message each, on the line."""

import pytest

pytest.importorskip("gymnasium")

from mindrun.errors import MindError

from tests.outside import minds, worlds

PARTS = worlds.name(worlds.Parts)
FOUR = "\n".join(f"actuator push{i} is choice {i + 1} neutral 0.5" for i in range(4))
LATE = "sensor late is observation late 0 range 0 to 1"


@pytest.mark.parametrize(
    ("source", "where", "message", "hint"),
    [
        (minds.text(scene="tests/Lime-v0"), "gymnasium tests/Lime-v0",
         "Gymnasium has no environment called tests/Lime-v0.", "Did you mean tests/Line-v0?"),
        (minds.text(scene="tests/Line"), "gymnasium tests/Line",
         "Gymnasium has no environment called tests/Line.", "Say which version: gymnasium tests/Line-v0."),
        (minds.text("sensor place is observation 2 range 0 to 1"), "place", "The environment has no observation 2.",
         "It has 2 numbers: 0 to 1."),
        (minds.text("sensor place is observation 0 0 range 0 to 1"), "place", "The environment has no observation 0 0.",
         "It has 2 numbers: 0 to 1."),
        (minds.text("sensor place is observations 0 to 9 range 0 to 1"), "place",
         "The environment has no observations 0 to 9.", "It has 2, which are counted through: 0 to 1."),
        (minds.text("sensor place is observation image 0 range 0 to 1"), "place",
         "The observation of the environment has no part called image.", "Write observation 0."),
        (minds.text("sensor place is observation 0 range 0 to 1", FOUR, PARTS), "place",
         "The observation of the environment has several parts.",
         "Its parts are late, point.at: write observation late 0."),
        (minds.text(LATE, scene=PARTS), "push", "The environment takes one of a few actions, and no numbers.",
         "Write one actuator for each that is to be chosen: choice 1."),
        (minds.text(LATE, f"{FOUR}\nactuator more is choice 5 neutral 0", PARTS), "more",
         "The environment has no choice 5.", "Its choices are 1 to 4."),
        (minds.text(actuators="actuator push is choice 0 neutral 0.5"), "push",
         "The environment takes numbers, and no choices.", "Write one actuator for each of them: action 0."),
        (minds.text(actuators=f"{minds.PUSH}\nactuator more is action 1 neutral 0.5"), "more",
         "The environment has no action 1.", "It has 1 number: 0."),
        (minds.text(actuators=f"{minds.PUSH}\nactuator more is action 0 neutral 0.5"), None,
         "Two actuators are action 0.", "Leave one of them out."),
        (minds.text(actuators="actuator push is action 0 neutral 0.5 range 2"), "push",
         "An action has a range with two ends.", "Write range -1 to 1."),
        (minds.text(actuators="actuator way is choice 0 1 neutral 0", scene=worlds.name(worlds.Several)), None,
         "No actuator is a choice of the environment.", "Add one for each: actuator wait is choice 1 0 neutral 0."),
        (minds.text(actuators="actuator lamp is lamp neutral 0"), None, "No actuator is action 0 of the environment.",
         "Add it: actuator thrust is action 0 neutral 0.5."),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_told_on_its_line(source: str, where: str | None, message: str, hint: str) -> None:
    found = minds.compiled(source).diagnostics
    assert [(each.message, each.hint) for each in found] == [(message, hint)]
    assert found[0].span.text == (where or f"task Go in gymnasium {source.split(' in gymnasium ')[1].split()[0]}")


def test_of_another_package_nothing_is_run_before_the_rollout() -> None:
    source = minds.text(scene="surely_not_there:Line-v0")
    assert minds.compiled(source).diagnostics == ()
    with pytest.raises(MindError, match="no environment called surely_not_there:Line-v0") as found:
        minds.rollout_of(source)
    assert found.value.hint == "There is no module surely_not_there, neither installed nor beside the mind."


def test_the_newest_version_is_not_taken_for_one_that_is_not_said() -> None:
    """Of a module that nobody asks before a run: tomorrow it has another one."""
    source = minds.text(scene="tests.outside.kept:tests/Line")
    assert minds.compiled(source).diagnostics == ()
    with pytest.raises(
        MindError, match=r"Gymnasium has no environment called tests\.outside\.kept:tests/Line\."
    ) as found:
        minds.rollout_of(source)
    assert found.value.hint == "Say which version: gymnasium tests.outside.kept:tests/Line-v0."


def test_without_gymnasium_a_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    graph_source = minds.text()
    assert minds.compiled(graph_source).graph is not None
    monkeypatch.setitem(__import__("sys").modules, "gymnasium", None)
    with pytest.raises(MindError, match="needs the package gymnasium") as found:
        minds.rollout_of(graph_source)
    assert found.value.hint == "Install it: pip install 'mindlang[gymnasium]'."


def test_of_two_environments_it_is_said_which_one_it_is() -> None:
    second = f"task Other in gymnasium {PARTS}\n  lasts 5 ticks\n"
    found = minds.compiled(minds.text() + second).diagnostics
    assert f"The observation of the environment {PARTS} has several parts." in [each.message for each in found]
    assert all(PARTS in each.message for each in found)


def test_what_cannot_be_made_here_is_no_mistake_of_the_file() -> None:
    worlds.register()
    source = minds.text(scene=worlds.name(worlds.Unmade))
    assert minds.compiled(source).diagnostics == ()
    with pytest.raises(MindError, match="cannot be made") as found:
        minds.rollout_of(source)
    assert found.value.hint == "ImportError: no physics here"


def test_an_environment_may_be_that_of_a_scene() -> None:
    source = minds.text(scene="tests/Lime-v0").replace("task Go in gymnasium tests/Lime-v0", "task Go in Sky")
    found = minds.compiled(source + "scene Sky is gymnasium tests/Lime-v0\n").diagnostics
    assert [(each.code, each.span.text) for each in found] == [("unknown-environment", "gymnasium tests/Lime-v0")]
    right = source + "scene Sky is gymnasium tests/Line-v0\n"
    assert minds.compiled(right).diagnostics == ()
    assert minds.rollout_of(right).task.scene.environment == "tests/Line-v0"


def test_what_is_of_two_values_has_two_choices() -> None:
    from gymnasium.spaces import MultiBinary
    from mindrun.kinds.environment import Slot
    from mindrun.sim.outside.parts import spaces_of
    from mindrun.sim.outside.wiring import misfits

    both = spaces_of(MultiBinary(2), MultiBinary(2))
    each = {f"push{i}{chosen}": Slot("", (i,), chosen=chosen) for i in range(2) for chosen in range(2)}
    assert [*misfits(both, {}, each)] == []
    found = [*misfits(both, {}, each | {"more": Slot("", (1,), chosen=2)})]
    assert [(wrong.name, wrong.hint) for wrong in found] == [("more", "Its choices are 0 to 1.")]
