"""`mindc lsp`: a server with everything that it can do, on a stream of messages and one of answers."""

import logging
from typing import BinaryIO

from pygls.exceptions import JsonRpcException

from mindlang.server import commands, questions, texts
from mindlang.server.frames import Frames
from mindlang.server.server import MindServer


def make() -> MindServer:
    """A server that answers."""
    server = MindServer()
    for part in (texts, questions, commands):
        part.register(server)
    return server


def serve(messages: BinaryIO, answers: BinaryIO) -> int:
    """Serve until the editor says that it is over, or is gone; how the program ends."""
    for name in ("pygls.server", "pygls.protocol.json_rpc"):
        logging.getLogger(name).addFilter(_is_fault)
    server = make()
    server.start_io(Frames(messages), answers)  # type: ignore[arg-type]  # the methods that pygls calls
    return 0 if server.protocol._shutdown else 1


def _is_fault(record: logging.LogRecord) -> bool:
    """Whether something is worth a line in the editor's log: a refusal that the editor has been told is not."""
    error = record.exc_info[1] if record.exc_info else None
    return not isinstance(error, JsonRpcException) and not str(record.msg).startswith("Unable to ")
