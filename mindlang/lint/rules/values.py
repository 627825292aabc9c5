"""Values and conditions that are the same whatever is read."""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Edge, End, Part, Promise
from mindlang.editing.insertion import replace_span
from mindlang.lint.intervals import interval, is_constant, range_in_words, why_always, why_never
from mindlang.lint.study import Finding, Found, Study, is_zero_influence, removal, rule

REMEDY = "Compare with something that is sometimes reached, or leave the condition out."
AT_ONCE = "A run would end with its first tick: compare with something that is sometimes reached."


@rule()
def constant_condition(study: Study) -> Found:
    for when, of, world in study.conditions:
        if isinstance(of, Edge | Part | Promise) and (never := why_never(when, world.range_in(of))):
            yield Finding(when.span, f"This condition never holds: {never}.", REMEDY)
        elif always := why_always(when, world.range_in(of)):
            hint = AT_ONCE if isinstance(of, End) else REMEDY
            yield Finding(when.span, f"This condition always holds: {always}.", hint)


@rule()
def constant_sensor(study: Study) -> Found:
    for part in study.mind.sensors:
        constant = study.any_world.constant(part.name)
        if constant is not None:
            yield Finding(part.span, f"{part.name} always reads {constant:g}.", f"{part.kind.remedy}, or take it out.")


@rule()
def value_out_of_range(study: Study) -> Found:
    # an influence that is always 0 is for edge-at-zero to tell
    sent = (
        edge for skill, edge in study.edges if not (is_zero_influence(edge) or (skill.chooses and edge.to == "skill"))
    )
    for value in (value for edge in sent for value in edge.values):
        low, high = interval(value)
        if low > 1 or high < 0 or (not is_constant(value) and (low == 1 or high == 0)):
            clamped = 1 if low >= 1 else 0
            share = f", or {low:g}% if that is meant" if low == high and 1 < low <= 100 else ""
            message = f"This value is {range_in_words((low, high))}, which is clamped to {clamped}."
            hint = f"Write {clamped}{share or ', or a value that gets between 0 and 1'}."
            fix = Fix(f"Write {clamped}", (replace_span(value.span, str(clamped)),))
            yield Finding(value.span, message, hint, fix=fix)


@rule()
def edge_at_zero(study: Study) -> Found:
    for skill, edge in study.edges:
        if edge.at and is_zero_influence(edge) and not skill.chooses:
            message = f"{skill.name} never has influence on {edge.target}: this is always 0."
            hint = "Give it a value above 0, or take the line out."
            yield Finding(edge.at.span, message, hint, fix=removal(edge.fact) if len(skill.edges) > 1 else None)
