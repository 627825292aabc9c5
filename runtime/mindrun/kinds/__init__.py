"""The kinds: dataclasses whose fields are their arguments, and which say of themselves what the rest asks."""
