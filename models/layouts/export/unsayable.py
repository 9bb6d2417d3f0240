"""What a format has no words for."""

from __future__ import annotations


class Unsayable(Exception):
    """A layout, or something in it, that a format cannot tell; the text says what."""
