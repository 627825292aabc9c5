"""The command line of `mindrun`: its arguments and its tools."""
