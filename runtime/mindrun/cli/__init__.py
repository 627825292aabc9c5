"""The command line of `mindrun`: its arguments, its completion, and its tools."""
