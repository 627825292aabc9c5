"""Lint: what a mind says that compiles and yet is hardly meant. One rule a file in `rules`."""
