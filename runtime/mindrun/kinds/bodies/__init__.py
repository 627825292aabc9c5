"""Kinds of bodies, one file each: their outline, their mass, and what can move them."""
