"""What can be proved of promises: that no skill above one lets it act against what it requires."""

from mindrun.numbers.expression import evaluate

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.proofs.proof import prove

MIND = """\
tick 1/20 s
master Feed
body Rover is disc
actuator left_wheel is wheel side left neutral 0.5
sensor charge is battery
sensor near is distance of dock
memory mood is cell decay 0.9
skill Rest is rule
  requires charge < 1/3
  drives left_wheel at 0.5
skill Seek is rule
  requires charge > 5%
  requires charge > 6% or near > 50%
  requires mood <= 0.8
  drives left_wheel at 1
skill Feed is rule
  reads charge
  reads mood
  influences Seek at 1 when charge > 5% and mood < 0.8 otherwise 0
  influences Rest at 1/3 - charge
"""


def test_each_requirement_is_proved_or_broken() -> None:
    graph = compile_source(Source("feed.mind", MIND)).graph
    assert graph
    found = {each.promise.text: each for each in prove(graph, {}, 0.01).requirements}
    broken = found.pop("requires charge > 6% or near > 50%")
    assert [each.holds for each in found.values()] == ["always"] * 3
    assert broken.holds == "can be broken"
    assert broken.readings is not None
    assert evaluate(broken.promise.when, broken.readings) == 0
    assert 0.05 < float(broken.readings[0]) <= 0.06
