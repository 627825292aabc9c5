"""Lint: what a mind says that compiles and yet is hardly meant."""
