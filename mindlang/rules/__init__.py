"""Lint rules, one a file: docstring = explanation, GOOD and BAD = examples and tests, `check` = the rule."""
