"""Drivers, one file each: what a sensor or an actuator of a mind is wired to. All are known once this is imported."""

from importlib import import_module
from pkgutil import iter_modules

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")
