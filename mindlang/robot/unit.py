"""The service that runs the current release, for the systemd of the robot's user: it needs no root, and no password."""

SERVICE, ARMED = "mind.service", "mind-armed.service"  # what they are called in a release

UNIT = """\
# Written by `mindc deploy`, which replaces it; `systemctl --user edit mind.service` is for changes that stay.
[Unit]
Description=The mind of this robot, {state}
StartLimitIntervalSec=60
StartLimitBurst=5

[Service]
# Ready when every sensor has been measured once; then each tick is told, and two seconds without one are the end.
Type=notify
NotifyAccess=main
WatchdogSec=2
# Entered once: a process keeps the release that it was started in, whatever is current later.
WorkingDirectory=%h/mind/current
# No .pyc files: a release stays what was sent, and a power cut leaves none that is half written.
Environment=PYTHONPATH=runtime PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1
ExecStart={run}
{neutral}Restart=on-failure
# 2 is said on purpose: a bundle that is refused, or a guardian that will move nothing more.
RestartPreventExitStatus=2
RestartSec=2
# Only the controller is told to end; the guardian ends after it, once every actuator is at neutral.
KillMode=mixed
TimeoutStopSec=10
LimitCORE=0
NoNewPrivileges=yes

[Install]
WantedBy=default.target
"""
PYTHON = "%h/mind/venv/bin/python"


def unit(arm: bool = False) -> str:
    """The unit's text. Armed, the mind moves what is wired to it, and however it ends everything goes to neutral."""
    run = f"{PYTHON} -m mindrun mind.bundle" + " --arm" * arm
    neutral = f"ExecStopPost={PYTHON} -P -m mindrun.robot.guardian --neutral mind.bundle\n" * arm
    return UNIT.format(state="armed" if arm else "not armed", run=run, neutral=neutral)
