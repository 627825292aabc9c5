"""What there is to know of something declared, as Markdown: what an editor shows when the mouse rests on its name."""

from collections.abc import Iterator

from mindrun.errors import MindError
from mindrun.kinds.registry import kinds
from networkx import DiGraph, single_target_shortest_path

from mindlang.compiler.comments import comment_of
from mindlang.compiler.drawing import text_after_name
from mindlang.compiler.syntax import Contains, Declaration, Drives, Influences, Reads, Teaches
from mindlang.explaining import markdown
from mindlang.explaining.kinds import kind_article
from mindlang.lock import lock_sources
from mindlang.lock.report import Row, made_by, rows
from mindlang.lock.status import Trained
from mindlang.server.view import MindView


def card(view: MindView, noun: str, name: str) -> str:
    """Everything about a name; nothing where another declaration has it already."""
    if noun == "thing":
        return _thing(view, name)
    if noun == "number" and name in view.names.numbers:
        return _number(view, name)
    declaration = view.names.table.get(noun, {}).get(name)
    if declaration is None:
        return ""
    parts = [f"```mind\n{declaration.header.span.text.strip()}\n```", declaration.comment]
    match noun:
        case "skill":
            parts += _skill(view, name, declaration)
        case "task" | "scene":
            parts += _world(view, noun, name)
        case "sensor" | "memory" | "actuator":
            parts += _part(view, noun, name)
    parts.append(_of_kind(noun, declaration))
    return "\n\n".join(filter(None, parts))


def paths_to(view: MindView, skill: str) -> list[str]:
    """The ways on which influence comes down to a skill, the shortest one from each top."""
    influences: DiGraph = DiGraph()
    for name, declaration in view.names.declarations("skill"):
        influences.add_node(name)
        facts = (fact for fact in declaration.facts if isinstance(fact, Influences))
        influences.add_edges_from((name, fact.name.text) for fact in facts)
    ways = single_target_shortest_path(influences, skill).items()
    return [" → ".join(way) for top, way in ways if top != skill and not influences.pred[top]]


def _skill(view: MindView, name: str, declaration: Declaration) -> Iterator[str]:
    lines = []
    for verb, form in (("reads", Reads), ("drives", Drives), ("influences", Influences)):
        if said := [_edge(view, fact) for fact in declaration.facts if isinstance(fact, form)]:
            lines.append(f"- {verb} {', '.join(said)}")
    if by := _users(view, name, "skill", (Influences,)):
        lines.append(f"- influenced by {', '.join(by)}")
    if view.compiled.mind and view.compiled.mind.master == name:
        lines.append("- the master")
    lines += [f"- place: {path}" for path in paths_to(view, name)]
    yield "\n".join(lines)
    yield "\n".join(f"- `{lesson}`" for lesson in _lessons(view, "skill", name))
    yield _weights(view, name)


def _edge(view: MindView, fact: Reads | Drives | Influences) -> str:
    width = _width(view, fact.name.text) if isinstance(fact, Reads) else 1
    said = "" if isinstance(fact, Reads) else text_after_name(fact)
    return f"{fact.name.text} ({width})" if width > 1 else f"{fact.name.text}{said}"


def _width(view: MindView, sensor: str) -> int:
    graph = view.compiled.graph
    return next((known.width for known in graph.sensors if known.name == sensor), 1) if graph else 1


def _weights(view: MindView, skill: str) -> str:
    """How a skill stands to its weights, as `mindc status` says it."""
    if view.compiled.graph is None:
        return ""
    try:
        found = rows(view.compiled.graph, lock_sources(view.compiled.sources))
        row = next((row for row in found if row.skill == skill), None)
    except MindError as error:
        return f"Weights: {error}"
    return _row(row) if row else ""


def _row(row: Row) -> str:
    words = [row.word] + ["frozen"] * row.is_frozen
    made = []
    if isinstance(row.status, Trained):
        how = f"those of {row.like}" if row.like else made_by(row.status.entry.taught)
        made.append(f"{row.status.entry.weights[:8]}…, {how}")
    return "\n".join([f"Weights: **{', '.join(words)}**", *(f"- {line}" for line in [*made, *row.remarks])])


def _world(view: MindView, noun: str, name: str) -> Iterator[str]:
    """All that a task or scene says, that of its scene and of what it is like, too."""
    declaration = view.whole.table[noun][name]
    yield "\n".join(f"- {fact.span.text.strip()}" for fact in declaration.facts)
    if noun == "task":
        yield "\n".join(f"- `{lesson}`" for lesson in _lessons(view, "task", name))


def _number(view: MindView, name: str) -> str:
    """A number, and what its comment says."""
    number = view.names.numbers[name]
    return f"```mind\n{number.span.text.strip()}\n```\n\n{comment_of(number.span)}".strip()


def _part(view: MindView, noun: str, name: str) -> Iterator[str]:
    lines = []
    if noun == "sensor" and (width := _width(view, name)) > 1:
        lines.append(f"- {width} readings")
    if noun != "actuator" and (by := _users(view, name, noun, (Reads,))):
        lines.append(f"- read by {', '.join(by)}")
    if noun != "sensor" and (by := _users(view, name, noun, (Drives,))):
        lines.append(f"- driven by {', '.join(by)}")
    if others := _others(view, noun, name):
        lines.append(f"- stands in {', '.join(others)}")
    yield "\n".join(lines)


def _others(view: MindView, noun: str, name: str) -> list[str]:
    """What else names a part: other sensors, and tasks in their rewards."""
    found = (m for m in view.mentions if (m.noun, m.name.text) == (noun, name) and m.by and not m.is_own)
    headers = (m.by.header for m in found if m.by)
    others = (f"{h.noun.text} {h.name.text}" for h in headers if h.noun.text != "skill")
    return list(dict.fromkeys(others))


def _users(view: MindView, name: str, noun: str, forms: tuple[type[Reads | Drives | Influences], ...]) -> list[str]:
    """The skills that have a fact of one of these verbs about a name."""
    return [
        skill
        for skill, declaration in view.names.declarations("skill")
        if any(isinstance(fact, forms) and fact.name.text == name for fact in declaration.facts)
    ]


def _lessons(view: MindView, part: str, name: str) -> Iterator[str]:
    """The lessons that teach a skill, or are on a task."""
    for curriculum, declaration in view.names.declarations("curriculum"):
        for fact in declaration.facts:
            if isinstance(fact, Teaches) and getattr(fact, part).text == name:
                yield f"{curriculum}: {fact.span.text.strip()}"


def _thing(view: MindView, name: str) -> str:
    """Where a thing is."""
    lines = []
    for noun in ("scene", "task"):
        for world, declaration in view.names.declarations(noun):
            for fact in declaration.facts:
                if isinstance(fact, Contains) and fact.name.text == name:
                    lines.append(f"- in {world}: `{fact.phrase.span.text}`")
    return "\n".join([f"**{name}**, a thing", "", *lines])


def _of_kind(noun: str, declaration: Declaration) -> str:
    phrase = declaration.header.phrase
    is_known = phrase is not None and phrase.kind.text in kinds(noun)
    return f"---\n{markdown.card(kind_article(noun, phrase.kind.text))}" if phrase and is_known else ""
