"""The checks of `mindc doctor`: what this machine and this installation have, and the line that mends what they lack."""
