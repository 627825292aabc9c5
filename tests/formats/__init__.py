"""What every released version wrote, and the program that writes what the present one does."""

from pathlib import Path

FOLDER = Path(__file__).parent
RELEASES = sorted(path.name for path in FOLDER.iterdir() if path.name[0].isdigit())
MINDS = ("boat", "car", "glider", "lander", "rover", "tractor")  # of 0.1.0: `parts.mind` is used by them
