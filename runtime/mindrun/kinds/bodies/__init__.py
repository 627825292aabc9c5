"""Kinds of bodies: their outline, their mass, and what can move them."""
