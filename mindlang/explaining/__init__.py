"""Explanations of kinds, drivers, codes, words and commands: to be printed, hovered and published."""
