"""A run or a recording seen in a browser: what it consists of as bytes, and the server that says it."""
