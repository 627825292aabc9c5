"""Pictures and films of runs, drawn with OpenCV."""
