"""The differences between the world in which a skill was taught and the one in which its lesson teaches now."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from math import degrees, sin
from typing import Any

from mindrun.numbers.quantity import ANGLE

from mindlang.lock.training_world import TrainingWorld
from mindlang.lock.world_facts import argument, completed, meaning_of, number

PARTS = ("sensor", "memory", "actuator", "thing")
SAME_DIRECTION = 1e-9  # so far apart may be the sines of what is one direction to a reader
NOUNS = {"thing": "content"}  # of the registry, where it says another


def changes(old: TrainingWorld, now: TrainingWorld) -> list[str]:
    """Each difference as a sentence. The order of lines is none, nor what a skill reads or sends beside its `at`s."""
    return [*_changes(old.facts, now.facts)]


def _changes(old: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    if old["tick"] != now["tick"]:
        yield f"taught with tick {_tick(old['tick'])}, now {_tick(now['tick'])}"
    if "physics" in old and "physics" in now:
        was, is_ = old["physics"], now["physics"]
        if was["pymunk"] != is_["pymunk"]:
            yield f"taught with pymunk {was['pymunk']}, now {is_['pymunk']}"
        if was["world"] != is_["world"]:
            yield f"taught in version {was['world']} of the simulated world, now {is_['world']}"
    yield from _kind_changes("body", "body", old["body"], now["body"])
    for subject in sorted(old.keys() & now.keys()):
        noun, _, name = subject.partition(" ")
        if noun in PARTS:
            yield from _kind_changes(NOUNS.get(noun, noun), name, old[subject], now[subject])
        elif noun == "skill":
            yield from _skill_changes(name, old[subject], now[subject])
    for subject in sorted(old.keys() ^ now.keys()):  # of the actuators those that move something in one of the worlds
        noun, _, name = subject.partition(" ")
        if noun == "actuator":
            yield f"taught with {name}, which does nothing now" if subject in old else f"taught without {name}"
        if noun == "thing":
            yield f"its task has changed: {'contains' if subject in now else 'no longer contains'} {name}"
    yield from _claw_changes(old, now)
    yield from _task_changes(old, now)
    before, after = _beginning(old["lesson"]), _beginning(now["lesson"])
    if before != after:
        yield f"taught {before}, now {after}"
    before, after = (lesson.get("hard", "none") for lesson in (old["lesson"], now["lesson"]))
    if before != after:
        yield f"taught with hard layouts {before}, now {after}"
    yield from _kind_changes("curriculum", "the learner", old["lesson"]["learner"], now["lesson"]["learner"])


def _tick(seconds: float) -> str:
    a_second = 1.0 / seconds
    return f"1/{a_second:.6g} s" if abs(a_second - round(a_second)) < 1e-9 * a_second else f"{number(seconds)} s"


def _kind_changes(noun: str, name: str, old: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    """The differences of a part, in sentences. An argument that only one version of mindc knows is none.

    One that is left out where it is the default is that.
    """
    if old["is"] != now["is"]:
        yield f"taught with {name} as {old['is']}, now {now['is']}"
        return
    old, now = completed(noun, old), completed(noun, now)
    for field in [field for field in now if field != "is" and field in old and old[field] != now[field]]:
        if isinstance(now[field], list) and any(isinstance(each, str) for each in now[field]):
            yield f"the text of {name} has changed"
        elif meaning_of(noun, now["is"], field) != ANGLE or not _are_one_direction(old[field], now[field]):
            before, after = (argument(noun, now["is"], field, each[field]) for each in (old, now))
            yield f"taught with {name} {before}, now {after.removeprefix(before.partition(' ')[0] + ' ')}"


def _are_one_direction(old: Any, now: Any) -> bool:
    """True if directions are those of before, each perhaps written otherwise: -90 deg is 270 deg."""
    before, after = (value if isinstance(value, list) else [value] for value in (old, now))
    known = len(before) == len(after) and all(isinstance(each, int | float) for each in (*before, *after))
    return known and all(abs(sin((a - b) / 2)) < SAME_DIRECTION for a, b in zip(before, after, strict=True))


def _skill_changes(name: str, old: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    if old.get("text") != now.get("text") and old.get("text") and now.get("text"):
        yield f"the text of {name}'s procedure has changed"
    had, has = old.get("files", {}), now.get("files", {})
    changed = (file for file in had if had[file] != has.get(file) and had[file] and has.get(file))
    yield from (f"{file}, which {name} uses, has changed" for file in changed)
    before, after = _skill_words(old), _skill_words(now)
    gone, new = ", ".join(sorted((before - after).elements())), ", ".join(sorted((after - before).elements()))
    if gone and new:
        yield f"{name} has changed: {gone}, now {new}"
    elif gone or new:
        yield f"{name} has changed: {gone or new} is {'new' if new else 'gone'}"


def _skill_words(skill: Mapping[str, Any]) -> Counter[str]:
    """The facts of a skill as words, each with its count, without the text of its procedure."""
    said = {key: [value] if isinstance(value, str) else value for key, value in skill.items() if key != "text"}
    return Counter(f"{word} {each}" for word, values in said.items() for each in values)


def _claw_changes(old: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    """The claw's reach, where it is not told as an argument of a gripper, or since items came or went."""
    if "claw" in old and "claw" in now and old["claw"] != now["claw"]:
        shared = [subject for subject in old.keys() & now.keys() if subject.startswith("actuator ")]
        if all(old[subject].get("reach") == now[subject].get("reach") for subject in shared):
            yield f"taught with a claw's reach of {number(old['claw'])}, now {number(now['claw'])}"


def _task_changes(old: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    told = [*_scene_changes(old["task"], now["task"])] if "task" in old and "task" in now else []
    varying = _listed_changes(old, now, "varying")
    told += [f"no longer {each}" if is_gone else f"{each} is new" for each, is_gone in varying]
    told += _reward_changes(old["rewards"], now["rewards"])
    yield from (f"its task has changed: {change}" for change in told)
    if "environment" in old and "environment" in now and old["environment"] != now["environment"]:
        yield "the text of its task's environment has changed"
    before, after = old.get("start"), now.get("start")
    if _is_another_start(before, after):
        yield f"its task has changed: {_start(after)}, before {_start(before)}"


def _listed_changes(old: Mapping[str, Any], now: Mapping[str, Any], key: str) -> Iterator[tuple[str, bool]]:
    """The texts of a list that only one of the two has, each with whether it is gone."""
    before, after = set(old.get(key, ())), set(now.get(key, ()))
    yield from ((each, True) for each in sorted(before - after))
    yield from ((each, False) for each in sorted(after - before))


def _is_another_start(old: Any, now: Any) -> bool:
    if not old or not now:
        return bool(old != now)
    is_turned = old["facing"] != now["facing"] and not _are_one_direction(old["facing"], now["facing"])
    return is_turned or bool(old["at"] != now["at"])


def _start(start: Any) -> str:
    """Where a robot starts, in words."""
    at, facing = (start["at"], start["facing"]) if start else (None, None)
    words = f"starts at {number(at[0])} {number(at[1])}" if isinstance(at, list) and len(at) == 2 else "starts anywhere"
    return f"{words} facing {degrees(facing):g} deg" if isinstance(facing, float) else words


def _scene_changes(old: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[str]:
    kind = now["scene"]["is"]
    if old["scene"]["is"] != kind:
        yield f"in {old['scene']['is']}, now {kind}"
    else:
        for field, value in now["scene"].items():
            if old["scene"].get(field, value) != value:
                before, after = (argument("task", kind, field, each) for each in (old["scene"][field], value))
                of = "" if field == kind else f"{kind} "
                yield f"in {of}{before}, now {after.partition(' ')[2]}"
    if old["ticks"] != now["ticks"]:
        yield f"lasts {old['ticks']} ticks, now {now['ticks']}"
    for verb in ("ends", "succeeds", "opens"):
        for each, is_gone in _listed_changes(old, now, verb):
            on = "" if verb == "opens" or each.startswith("when ") else "on "
            yield f"{'no longer ' * is_gone}{verb} {on}{each}"


def _reward_changes(old: Sequence[Sequence[str]], now: Sequence[Sequence[str]]) -> Iterator[str]:
    """Rewards that pay another amount for the same, that are gone and that are new."""
    gone = Counter(map(tuple, old)) - Counter(map(tuple, now))
    new = Counter(map(tuple, now)) - Counter(map(tuple, old))
    amounts = {reason: amount for amount, reason in new}
    for amount, reason in sorted(gone.elements()):
        if reason in amounts:
            after = amounts.pop(reason)
            new[after, reason] -= 1
            yield f"rewards {amount} {reason}, now {after}"
        else:
            yield f"no longer rewards {amount} {reason}"
    yield from (f"rewards {amount} {reason} is new" for amount, reason in sorted((+new).elements()))


def _beginning(lesson: Mapping[str, Any]) -> str:
    """The weights with which a lesson begins, in words."""
    if lesson["from_scratch"]:
        return "from scratch"
    return f"from {lesson['starts_from']}" if "starts_from" in lesson else "from its weights"
