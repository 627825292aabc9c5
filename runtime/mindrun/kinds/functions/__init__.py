"""Kinds of internal functions (Eq. 1): what turns a skill's inputs into its outputs."""
