"""A browser, which `mindc view` opens where there is one."""

import webbrowser
from collections.abc import Iterator

from mindlang.diagnosis.finding import Finding, State


def check() -> Iterator[Finding]:
    """One finding."""
    try:
        found = webbrowser.get()
    except webbrowser.Error:
        mend = "open the address that mindc view prints, from any machine that reaches it"
        yield Finding("browser", State.ABSENT, "none found", mend)
    else:
        yield Finding("browser", State.FINE, str(getattr(found, "name", "found")))
