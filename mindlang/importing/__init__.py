"""Weights that come from elsewhere: held against the engine, tried, and written into the lock with their origin."""
