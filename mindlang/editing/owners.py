"""Below which declarations the facts of each verb stand."""

OWNERS = {
    "skill": ("reads", "drives", "influences", "stays"),
    "task": ("lasts", "ends", "succeeds", "rewards", "counts", "contains", "starts", "varies", "fails"),
    "scene": ("contains", "starts", "varies", "fails"),
    "curriculum": ("teaches",),
}


def owner(fact: str) -> str:
    """The noun below which a fact of this verb stands; nothing where it begins with no verb."""
    verb = fact.partition(" ")[0]
    return next((noun for noun, verbs in OWNERS.items() if verb in verbs), "")
