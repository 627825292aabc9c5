"""One run of a task, or many: who plays, what is seen of it, and what came of it."""
