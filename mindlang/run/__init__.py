"""One run of a task, or many: set up, written down tick by tick, and the outcome as data, text and tables."""
