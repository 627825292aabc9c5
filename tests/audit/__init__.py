"""Tests of `mindc audit`."""
