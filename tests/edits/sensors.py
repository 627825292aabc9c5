"""The sensors and memories of drawn minds, by name: the lines of which each is one."""

KEPT = "register", "register start 1/2", "counter step 5%", "counter step 1/9"
CAMPS = "left rolled right spun compass north", "left spun right rolled compass south range 9"
SENSORS = {
    "eye": [
        "sensor eye is range_finder at 0 30 330 deg",
        "sensor eye is range_finder at -30 deg 0 deg 30 deg range 12",
        "sensor eye is range_finder at 30 to -30 by 15 deg",
        "sensor eye is range_finder at 0 20 deg on tilt",
    ],
    "charge": ["sensor charge is battery"],
    "beat": ["sensor beat is sine period 2 s", "sensor beat is sine period 0.5 s"],
    "ball_bearing": ["sensor ball_bearing is bearing of ball on pan", "sensor ball_bearing is bearing of nest"],
    "gaze": ["sensor gaze is direction of pan", "sensor gaze is direction of tilt"],
    "drift": ["sensor drift is derivative of ball_bearing", "sensor drift is derivative of north"],
    "mood": [f"memory mood is {kind}" for kind in ("cell decay 0.9", "cell decay 95%", *KEPT)],
    "camp": [f"memory camp is place {by}" for by in CAMPS],
    "south": ["sensor south is compass dead_zone 1%"],
    "spun": ["sensor spun is odometer side right range 5"],
    "back": ["sensor back is bearing of camp", "sensor back is distance of camp range 5"],
    "north": ["sensor north is compass"],
    "flight": ["sensor flight is turned of ball_bearing by 180 deg", "sensor flight is turned of north by -45 deg"],
    "flip": ["sensor flip is mirrored of ball_bearing", "sensor flip is mirrored of north"],
    "near": ["sensor near is contact of ball", "sensor near is contact of coin"],
    "holding": ["sensor holding is held of ball", "sensor holding is held of coin"],
    "home": ["sensor home is inside of nest", "sensor home is inside of dock"],
    "moving": ["sensor moving is inertial"],
    "heard": ["sensor heard is signal of mate", "sensor heard is signal of kin range 9"],
    "way": ["sensor way is distance of ball", "sensor way is distance of nest range 9"],
    "glow": ["sensor glow is light of ball", "sensor glow is light of dock range 4"],
    "camera": ["sensor camera is eye of ball at -30 30 deg", "sensor camera is eye of nest at 0 40 deg on pan"],
    "turning": ["sensor turning is turn_rate", "sensor turning is turn_rate range 90 deg dead_zone 1%"],
    "pace": ["sensor pace is speed", "sensor pace is speed range 3 dead_zone 2%"],
    "rolled": ["sensor rolled is odometer side left", "sensor rolled is odometer side right range 4"],
    "place": ["sensor place is position along x", "sensor place is position along y range 20"],
    "level": [
        "sensor level is computed at 1 - charge",
        "sensor level is computed at least of charge moving",
        "sensor level is computed at 1 - charge when moving > 0.5 and charge < 80% otherwise moving",
    ],
    "hungry": [
        "sensor hungry is latch of charge below 20% above 80%",
        "sensor hungry is latch of moving below 1/9 above 1",
    ],
    "calm": ["sensor calm is average of moving over 30 ticks", "sensor calm is average of holding over 2 ticks"],
    "first": ["sensor first is reading 1 of eye", "sensor first is reading 2 of camera"],
    "hour": ["sensor hour is clock period 4 s", "sensor hour is clock period 1 s"],
    "line": ["sensor line is floor of nest", "sensor line is floor of ball at 0.5 -0.5 ahead 1"],
    "asked": ["sensor asked is order 1 to 3", "sensor asked is order 1 to 4 every 2 s lost 10% neutral 2 timeout 3 s"],
    "pull": ["sensor pull is order -1 to 1", "sensor pull is order 0 to 2 every 1 s lost 5% neutral 1 timeout 1 s"],
    "bumps": ["sensor bumps is bumper at -45 45 deg", "sensor bumps is bumper at 0 180 deg width 90 deg"],
}
WIDE = {"eye", "camera", "line", "bumps", "asked", "camp"}
NARROW = SENSORS.keys() - WIDE  # readings of width 1
