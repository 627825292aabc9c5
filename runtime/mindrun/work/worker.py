"""Words of the frames that a process behind pipes answers with."""

from dataclasses import replace

from mindrun.work.frame import DIGEST_BYTES, Frame, pack

READY, ALIVE = "ready", "alive"  # what is said without being asked
FAILED = "failed"  # an answer that is no result
MAX_SILENT_SECONDS = 86_400  # that a worker may ask for


def answer_to(data: bytes, frame: Frame) -> bytes:
    """An answer as bytes, which says to which job it is one: by the SHA-256 at the job's end."""
    return pack(replace(frame, about={**frame.about, "of": data[-DIGEST_BYTES:].hex()}))


def failure(message: str, hint: str = "") -> Frame:
    """Why a job was not done."""
    return Frame(FAILED, {"message": message, "hint": hint})
