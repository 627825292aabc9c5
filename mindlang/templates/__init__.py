"""Robots and tasks of which `mindc new` makes a project: each is a file in `robots/` or `tasks/`, and only data."""
