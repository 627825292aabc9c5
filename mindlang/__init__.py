"""The compiler of the mind language: text → File → Mind → Graph."""
