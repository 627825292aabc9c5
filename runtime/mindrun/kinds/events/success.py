"""The run has succeeded."""

from mindrun.kinds.events.event import EventKind, Hindrance, TaskWorld
from mindrun.kinds.registry import kind


@kind("event", "success")
class Success(EventKind):
    """The run ends as a success: what a line of the task with `succeeds` says has come."""

    is_of_success = True

    def missing(self, task: TaskWorld) -> Hindrance | None:
        """A hindrance where no line of the task says when a run succeeds."""
        if task.can_succeed:
            return None
        return Hindrance("The task does not say what a success is.", "Add a line: succeeds on 5 delivery of red.")
