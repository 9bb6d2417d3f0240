"""The systems whose days can be simulated."""

from __future__ import annotations

from importlib import import_module

from models.days.system import System

NAMES = ("crossing", "tram", "alarm")
"""Each has its days in the file ``days.py`` of its folder."""


def system_of(name: str) -> System:
    """The system of a name; loaded when it is asked for, since its machines are compiled then."""
    system: System = import_module(f"models.{name}.days").SYSTEM
    return system
