"""What the examples of several rules have in common."""

EYE = "sensor eye is range_finder at 0 deg\n"
READS = f"{EYE}skill Go is rule\n  reads eye\n"
LEARNS = f"{EYE}skill Go is mlp\n  reads eye\n  drives left_wheel\n"
TURN = "skill Turn is mlp\n  reads eye\n  drives left_wheel\n"  # beside Go
COURSE = "task Course in arena\n  lasts 9 s\n"
REWARDED = f"{COURSE}  rewards forward per tick\n"
LESSON = "  teaches Go on Course for 10 generations\n"
SCHOOL = f"curriculum School is genetic\n{LESSON}"
