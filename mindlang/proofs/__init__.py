"""Proofs about a mind without running it: paths, leaks, bounds. One claim a file."""
