"""Messages as the protocol has them: each request is answered, with an error in words where it cannot be."""

from typing import Any

from lsprotocol import types
from pygls.exceptions import JsonRpcException, JsonRpcInternalError
from pygls.protocol import LanguageServerProtocol

from mindlang.server.frames import REFUSALS

NO_JSON, NO_REQUEST, NO_METHOD, NO_PARAMS, NOT_YET = -32700, -32600, -32601, -32602, -32002
BEFORE = (types.INITIALIZE, types.EXIT)  # what may come before the editor has introduced itself
AFTER = (types.EXIT,)  # what may come after it has said that all is over

Message = dict[str, Any]


class MindProtocol(LanguageServerProtocol):
    """The protocol of one editor, which holds every message against its form before anything is done with it."""

    def structure_message(self, data: Any) -> Any:
        """A message stays as JSON has it: what stands inside of one is none, whatever it looks like."""
        return data

    def handle_message(self, message: Any) -> None:
        """Answer a request, take note of a notification or an answer; refuse what is none of these."""
        if why := _malformed(message):
            self.refuse(_id(message), NO_REQUEST, why)
        elif (method := message.get("method")) is None:
            self._take_answer(message)
        elif untimely := self._untimely(method):
            self.refuse_request(message, *untimely)
        else:
            self._take(message)

    def refuse_request(self, message: Message, code: int, why: str) -> None:
        """Answer a request with an error; notifications have no answers."""
        if "id" in message:
            self.refuse(message["id"], code, why)
        elif code == NO_PARAMS:
            self._server.window_log_message(types.LogMessageParams(types.MessageType.Warning, why))

    def refuse(self, number: int | str | None, code: int, why: str) -> None:
        """Answer with an error."""
        self._send_data({"jsonrpc": "2.0", "id": number, "error": {"code": code, "message": why}})

    def _untimely(self, method: str) -> tuple[int, str] | None:
        """Why a message comes at the wrong time."""
        if self._shutdown and method not in AFTER:
            return NO_REQUEST, "After shutdown only exit can come."
        if self._workspace is None and method not in BEFORE:
            return NOT_YET, "The first request is initialize."
        if self._workspace is not None and method == types.INITIALIZE:
            return NO_REQUEST, "initialize has been asked already."
        return None

    def _take(self, message: Message) -> None:
        if self.get_message_type(message["method"]) is None:
            self.refuse_request(message, NO_METHOD, f"There is no method called {message['method'][:60]}.")
            return
        try:
            structured = super().structure_message(message)
        except JsonRpcException as error:
            self.refuse_request(message, NO_PARAMS, _unfit(message["method"], error))
            return
        super().handle_message(structured)

    def _take_answer(self, message: Message) -> None:
        """An answer to a request of ours; one to none of them, or of another form, is passed over."""
        if message["id"] not in self._request_futures:
            return
        try:
            structured = super().structure_message(message)
        except JsonRpcException as error:
            future = self._request_futures.pop(message["id"])
            future.set_exception(error)
            return
        super().handle_message(structured)

    def _send_response(self, msg_id: Any, result: Any = None, error: Any = None) -> None:
        """An answer; where something is wrong with the server itself, in one line."""
        if error is not None and error.code == JsonRpcInternalError.CODE:
            error = types.ResponseError(error.code, f"mindc failed: {error.message}. Please report it.")
        super()._send_response(msg_id, result, error)


def _malformed(message: Any) -> str:
    """Why JSON is no message; nothing where it is one."""
    if message in REFUSALS:
        return str(message)
    if not isinstance(message, dict):
        return "A message is one JSON object."
    if message.get("jsonrpc") != "2.0":
        return 'A message says "jsonrpc": "2.0".'
    if "id" in message and _id(message) is None:
        return "The id of a message is a whole number or a text."
    if "method" in message and not isinstance(message["method"], str):
        return "The method of a message is a text."
    if "method" not in message and "id" not in message:
        return "A message has a method, an id, or both."
    return ""


def _id(message: Any) -> int | str | None:
    found = message.get("id") if isinstance(message, dict) else None
    return found if isinstance(found, int | str) and not isinstance(found, bool) else None


def _unfit(method: str, error: JsonRpcException) -> str:
    """Which parameters do not fit, as far as it can be told."""
    cause = error.__cause__
    while isinstance(cause, BaseExceptionGroup):
        cause = cause.exceptions[0]
    notes = [note.partition(" @ ")[2] or note for note in getattr(cause, "__notes__", ())]
    where = f" ({notes[-1]})" if notes else ""
    return f"The parameters of {method} have another form{where}."
