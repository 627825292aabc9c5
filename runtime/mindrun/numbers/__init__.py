"""Numbers whose bits are the same everywhere, in a fixed order of + − × ÷; quantities with units."""
