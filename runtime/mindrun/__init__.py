"""What runs a compiled mind: the engine on numpy alone, and with the `sim` packages its worlds and its training."""

VERSION = "0.1.0"
