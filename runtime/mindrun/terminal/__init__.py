"""The standard streams, a line that is rewritten, and what may be said on a command line."""
