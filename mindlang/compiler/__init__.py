"""The compiler: text → File → Mind → Graph, for any input without an exception."""
