"""Shows a run or a recording in a browser: its rows as bytes, and the server that sends them."""
