"""The weights of a skill as they leave a lock."""

from mindrun.errors import WeightsError
from mindrun.graph.weights import Weights
from mindrun.terminal.command_line import command_line

from mindlang.lock.status import trained_weights
from mindlang.training.subject import Subject
from mindlang.weights.network import Network, network_of


def outgoing(subject: Subject, skill: str) -> tuple[Network, Weights]:
    """A skill's network and the weights that it was taught; MindError where it has none that fit."""
    network = network_of(subject.graph, skill)
    weights, refusals = trained_weights(subject.graph, subject.lock, [skill])
    if refusals:
        raise WeightsError(refusals[0], command_line("mindc", "train", subject.shown, skill))
    return network, weights[skill]
