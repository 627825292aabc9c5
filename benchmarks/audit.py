"""Rewards with planted mistakes, and clean ones, for `mindc audit`: how many of the mistakes are found, what else.

python benchmarks/audit.py        a few minutes on two cores
"""

import subprocess
import sys
from json import loads
from pathlib import Path
from tempfile import TemporaryDirectory

ROBOT = """
tick 1/20 s
master Home
body Rover is disc size 2
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor lamp_bearing is bearing of lamp
sensor lamp_distance is distance of lamp range 40
skill Home is rule
  reads lamp_bearing
  drives left_wheel at {left}
  drives right_wheel at {right}
skill Go is mlp hidden 1
  reads lamp_bearing
  drives left_wheel
  drives right_wheel
task Seek in arena size 40
  contains lamp is zone size 3 reached moves
  lasts 30 s
{lines}
curriculum School is genetic
  teaches Go on Seek for 10 generations
"""
STEERED = {"left": "0.7 + 2 * (lamp_bearing - 0.5)", "right": "0.7 - 2 * (lamp_bearing - 0.5)"}
COUNTED = "counts reach of lamp"
REACH = f"rewards 10 on reach of lamp\n{COUNTED}"
TOWARD = f"{REACH}\nrewards 0.1 * progress toward lamp per tick"
CORNER = "contains mat is zone size 0.5 at 19.7 19.7 reached stays\n"  # beyond where a robot can stand
MAT = "contains mat is zone size 12 reached moves\n"
# The code that has to be found, and the line at which it is; then the task.
PLANTED: dict[str, tuple[str, str, str]] = {
    "forward pays": ("loophole", "0.1 * forward", f"{TOWARD}\nrewards 0.1 * forward per tick"),
    "being there pays": ("loophole", "0.05 per tick", f"{TOWARD}\nrewards 0.05 per tick"),
    "being far pays": ("loophole", "0.1 * lamp_distance", f"{TOWARD}\nrewards 0.1 * lamp_distance per tick"),
    "being near pays": ("loophole", "when lamp_distance", f"{TOWARD}\nrewards 0.2 per tick when lamp_distance < 50%"),
    "patches pay": ("loophole", "visit", f"{TOWARD}\nrewards 2 on visit of patch size 4"),
    "something else pays": ("loophole", "reach of mat", f"{MAT}{TOWARD}\nrewards 10 on reach of mat"),
    "a look pays": ("loophole", "when lamp_bearing", f"{REACH}\nrewards 0.2 per tick when lamp_bearing > 0.6"),
    "away pays": ("loophole", "retreat", f"{REACH}\nrewards 0.5 * retreat from lamp per tick"),
    "one way pays": ("farmable", "advance", f"{REACH}\nrewards 0.1 * advance toward lamp per tick"),
    "to and fro pays": ("farmable", "forward", f"{TOWARD}\nrewards 0.003 * forward per tick"),
    "moving costs": ("trap", "-0.2", f"{TOWARD}\nrewards -0.2 * forward per tick"),
    "walls cost": ("trap", "-40", f"{TOWARD}\nrewards -40 on collision\nends on collision"),
    "none is paid": ("never-paid", "5 on reach of mat", f"{CORNER}{TOWARD}\nrewards 5 on reach of mat"),
    "none feels it": ("dominated", "progress", f"{REACH}\nrewards 0.0000001 * progress toward lamp per tick"),
    "in the corner": ("never-counted", "reach of mat", f"{CORNER}{TOWARD}\ncounts reach of mat"),
}
CLEAN: dict[str, str] = {
    "reach alone": REACH,
    "progress": TOWARD,
    "little progress": f"{REACH}\nrewards 0.001 * progress toward lamp per tick",
    "much progress": f"{REACH}\nrewards 0.3 * progress toward lamp per tick",
    "both ways": f"{REACH}\nrewards 0.1 * advance toward lamp per tick\nrewards -0.1 * retreat from lamp per tick",
    "time costs": f"succeeds on 3 reach of lamp\n{TOWARD}\nrewards -0.01 per tick",
    "walls cost little": f"{TOWARD}\nrewards -1 on collision",
    "walls end it": f"{TOWARD}\nends on collision",
    "one is enough": "succeeds on reach of lamp\nrewards 50 on success\nrewards 0.1 * progress toward lamp per tick",
    "five are enough": f"succeeds on 5 reach of lamp\n{TOWARD}",
    "being far costs": f"{TOWARD}\nrewards -0.01 * lamp_distance per tick",
    "two to reach": f"{MAT}{TOWARD}\nrewards 10 on reach of mat\ncounts reach of mat",
}


def mind(lines: str) -> str:
    """A robot with one task of these lines."""
    return ROBOT.format(lines="\n".join(f"  {line}" for line in lines.split("\n")), **STEERED)


def found(lines: str, folder: Path, *options: str) -> list[dict[str, str]]:
    """The findings of a task of these lines, each with the text of its line."""
    file = folder / "planted.mind"
    file.write_text(mind(lines), encoding="utf-8")
    run = subprocess.run(["mindc", "audit", file, "--json", *options], capture_output=True, text=True, check=False)
    if not run.stdout:
        raise SystemExit(run.stderr)
    text = file.read_text(encoding="utf-8").split("\n")
    return [each | {"text": text[each["line"] - 1]} for task in loads(run.stdout)["tasks"] for each in task["findings"]]


def main() -> None:
    """Print what was found of each."""
    hits = false = 0
    with TemporaryDirectory() as folder:
        for name, (code, words, lines) in PLANTED.items():
            codes = found(lines, Path(folder), *sys.argv[1:])
            is_hit = any(each["code"] == code and words in each["text"] for each in codes)
            hits += is_hit
            print(f"{name:20} {'found' if is_hit else 'MISSED':7} {[each['code'] for each in codes]}", flush=True)
        for name, lines in CLEAN.items():
            codes = found(lines, Path(folder), *sys.argv[1:])
            false += len(codes)
            said = [(each["code"], each["text"]) for each in codes]
            print(
                f"{name:20} {'clean' if not codes else 'FALSE':7} {said}",
                flush=True,
            )
    print(f"{hits} of {len(PLANTED)} planted mistakes found, {false} false findings in {len(CLEAN)} clean tasks")


if __name__ == "__main__":
    main()
