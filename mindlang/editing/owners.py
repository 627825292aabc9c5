"""Below which declarations the facts of each verb stand."""

OWNERS = {
    "skill": ("reads", "drives", "influences", "stays"),
    "task": ("lasts", "ends", "succeeds", "rewards", "counts", "contains", "starts", "varies", "fails"),
    "scene": ("contains", "starts", "varies", "fails"),
    "curriculum": ("teaches",),
}


def owners(fact: str) -> tuple[str, ...]:
    """The nouns below which a fact of this verb may stand; none where it begins with no verb."""
    verb = fact.partition(" ")[0]
    return tuple(noun for noun, verbs in OWNERS.items() if verb in verbs)
