"""A browser of this machine."""

import webbrowser
from contextlib import suppress
from threading import Thread


def open_browser(address: str) -> bool:
    """Open a browser with windows; whether there is one: what runs in a terminal would take this one."""
    with suppress(webbrowser.Error):
        browser = webbrowser.get()
        if type(browser) is not webbrowser.GenericBrowser:
            Thread(target=browser.open, args=(address,), daemon=True).start()
            return True
    return False
