"""A perceptron with more hidden layers than anyone means.

`hidden` counts layers, not neurons: `mlp hidden 8` has eight layers one behind the other, each as wide as Eq. 5 says,
and what many layers without biases compute is hard to learn. One layer of eight neurons is `mlp hidden 1 width 8`.
Where so many layers are meant, say how wide they are.
"""

from mindlang.lint.study import Finding, Found, Study

MOST_LAYERS = 3  # as many as the paper's largest has
GO = """
sensor eye is range_finder at 0 deg
skill Go is mlp hidden {}
  reads eye
  drives left_wheel
  drives right_wheel
"""
GOOD = (GO.format("1 width 8"), GO.format(MOST_LAYERS), GO.format("8 width 5"))
BAD = GO.format(8)


def check(study: Study) -> Found:
    for skill in study.mind.skills:
        hidden = getattr(skill.function, "hidden", 0)
        if hidden > MOST_LAYERS and "width" in skill.function.derived and not skill.like:
            hint = f"Write hidden 1 width {hidden} for one layer of so many neurons; hidden 2 does for most."
            yield Finding(skill.span, f"{skill.name} has {hidden} hidden layers one behind the other.", hint)
