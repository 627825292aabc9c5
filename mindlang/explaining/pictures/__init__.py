"""Small drawings for the pages of reference, as SVG: the same bytes on every machine."""
