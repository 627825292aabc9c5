"""What can be known of a mind without running it: what lint rules look at."""
