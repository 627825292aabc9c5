"""Bringing a bundle to a robot over the system's ssh and rsync: beside the old one, verified, switched at once."""
