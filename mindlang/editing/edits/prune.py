"""`mindc edit prune`."""

from mindrun.kinds.registry import phrase

from mindlang.editing.insertion import replace_span
from mindlang.editing.project import EditError, MindChange, Project, kind_of
from mindlang.lock import read_locks
from mindlang.lock.blobs import load_weights
from mindlang.lock.signature import arrange
from mindlang.lock.status import Trained, status


def prune(project: Project, skill: str) -> MindChange:
    """Take away neurons of a neat that lead to no output.

    It does the same, to the bit, in less time. There is room for no more neurons then than are left.

    Example: mindc edit prune grown.mind GoToObject
    """
    declaration = project.own_skill(skill)
    lock = read_locks(project.taught)
    graph = arrange(project.graph, lock)
    own = next(each for each in graph.skills if each.name == skill)
    written = declaration.header.phrase
    if not own.function.grows or written is None:
        hint = f"Only a neat has links that come and go: {project.main.source.edit('grow', skill)}"
        raise EditError(
            f"{skill} has no links to prune: its function is {kind_of(declaration)}.", hint, declaration.header.span
        )
    if not isinstance(status(graph, lock).get(skill), Trained):
        message = f"{skill} has no weights that fit, so nobody knows which neurons it uses."
        raise EditError(message, "Teach it first.", declaration.header.span)
    now = own.function.pruned(load_weights(lock[skill], own), own.outputs)
    if now == own.function:
        raise EditError(f"From each neuron of {skill} a way leads to an output.", "", declaration.header.span)
    return MindChange((replace_span(written.span, phrase(now)),), recast=skill)
