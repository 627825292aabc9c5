"""`mindc edit grow`."""

from mindrun.kinds.functions.neat import MOST_NEURONS

from mindlang.editing.insertion import replace_span
from mindlang.editing.project import EditError, MindChange, Project, kind_of


def grow(project: Project, skill: str) -> MindChange:
    """Make a neat of an mlp, which does the same.

    What it was taught stays, to the bit, and `genetic` goes on from there with links that come and go.

    Example: mindc edit grow collect.mind GoToObject
    """
    declaration = project.own_skill(skill)
    own = next(each for each in project.graph.skills if each.name == skill)
    phrase = declaration.header.phrase
    most = own.function.neurons_as_links(len(own.inputs), own.outputs)
    if most is None or phrase is None:
        kind = kind_of(declaration)
        hint = "Its links are learnt already." if kind == "neat" else "Only an mlp becomes a neat that does the same."
        raise EditError(f"{skill} cannot grow: its function is {kind}.", hint, declaration.header.span)
    if most > MOST_NEURONS:
        message = f"{skill} has {most} neurons, and a neat has room for {MOST_NEURONS}."
        raise EditError(message, "Teach a narrower one first.", declaration.header.span)
    grown = f"neat most {most}{' centred 1' * own.function.centred}"
    return MindChange((replace_span(phrase.span, grown),), recast=skill)
