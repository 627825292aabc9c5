"""The robot as a service of systemd: the unit's text, and the two things that a service says to its manager."""

import os
import socket
from contextlib import suppress
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Service:
    """What the unit of a robot says. `command` starts the controller, `neutral` is run whenever it has stopped.

    `watchdog` is in seconds. `groups` and `devices` are all that it may use.
    """

    robot: str
    command: str
    neutral: str
    folder: str
    user: str = "mind"
    arm: bool = False
    watchdog: float = 2.0
    groups: tuple[str, ...] = ("i2c", "spi", "gpio", "dialout", "video")
    devices: tuple[str, ...] = (
        "char-i2c",
        "char-spi",
        "char-gpiochip",
        "char-ttyAMA",
        "char-ttyUSB",
        "char-ttyACM",
        "char-video4linux",
    )


def unit(service: Service) -> str:
    """The text of a unit file."""
    allowed = "\n".join(f"DeviceAllow={device} rw" for device in service.devices)
    return f"""\
[Unit]
Description=mind on {service.robot}
StartLimitIntervalSec=60
StartLimitBurst=3

[Service]
Type=notify
NotifyAccess=main
ExecStart={service.command}{" --arm" if service.arm else ""}
ExecStopPost={service.neutral}
WorkingDirectory={service.folder}
User={service.user}
SupplementaryGroups={" ".join(service.groups)}
WatchdogSec={service.watchdog:g}
Restart=on-failure
RestartSec=1
# Only the controller is told to end; the guardian ends after it, once every actuator is at neutral.
KillMode=mixed
TimeoutStopSec=5
LimitCORE=0
LimitRTPRIO=20
LimitMEMLOCK=infinity
NoNewPrivileges=yes
ProtectSystem=strict
ProtectHome=read-only
PrivateTmp=yes
DevicePolicy=closed
{allowed}

[Install]
WantedBy=multi-user.target
"""


def notify(state: str) -> None:
    """Tell systemd "READY=1", "WATCHDOG=1" or "STOPPING=1"; nothing happens where it is not the one who started us."""
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address:
        return
    if address.startswith("@"):
        address = f"\0{address[1:]}"
    with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) as manager:
        manager.setblocking(False)
        manager.sendto(state.encode(), address)
