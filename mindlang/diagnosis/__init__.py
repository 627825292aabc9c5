"""The checks of `mindc doctor`: what is installed on this machine, and the line that mends what is missing."""
