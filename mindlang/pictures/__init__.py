"""Pictures and films of runs, drawn with OpenCV; how they were learnt, with matplotlib."""
