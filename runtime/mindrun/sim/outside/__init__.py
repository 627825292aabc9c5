"""Worlds that are environments of Gymnasium: what they observe and take, one that is stepped, many that are scored."""
