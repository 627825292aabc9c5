"""A file as `mindc fmt` writes it, as few changed lines as may be: the cursor and all marks stay where they are."""

from difflib import SequenceMatcher

from mindlang.format import formatted
from mindlang.source import Source
from mindlang.splice import Splice

MOST = 2000  # lines that are compared; difflib takes long over more


def tidied(source: Source) -> list[Splice]:
    """What has to change; lines that cannot be read stay as they are."""
    text = formatted(source.text)
    if text == source.text:
        return []
    before, after = source.text.splitlines(keepends=True), text.splitlines(keepends=True)
    if max(len(before), len(after)) > MOST:
        return [Splice(source, 0, len(source.text), text)]
    starts = [0]
    for line in before:
        starts.append(starts[-1] + len(line))
    blocks = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    return [
        Splice(source, starts[first], starts[last], "".join(after[start:end]))
        for tag, first, last, start, end in blocks
        if tag != "equal"
    ]
