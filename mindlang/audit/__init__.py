"""Audit: what the reward lines of a task pay whom, and what is to be said of them ([audit.md](../../docs/audit.md))."""
