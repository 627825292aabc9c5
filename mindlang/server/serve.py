"""`mindc lsp`: a server with everything that it can do, on standard input and output."""

import logging

from mindlang.server import commands, questions, texts
from mindlang.server.server import FAILED, MindServer


def make() -> MindServer:
    """A server that answers."""
    server = MindServer()
    for part in (texts, questions, commands):
        part.register(server)
    return server


def serve() -> int:
    """Serve until the editor says that it is over, or is gone; how the program ends."""
    logging.getLogger("pygls.protocol.json_rpc").addFilter(_is_fault)
    server = make()
    server.start_io()
    return 0 if server.protocol._shutdown else 1


def _is_fault(record: logging.LogRecord) -> bool:
    """Whether something is worth a line in the editor's log: a refusal that the user has been told is not."""
    error = record.exc_info[1] if record.exc_info else None
    return getattr(error, "code", None) != FAILED
