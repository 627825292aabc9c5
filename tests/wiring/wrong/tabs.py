"""It has a tab	in it."""
