"""The alarm's machines compiled, once for all that use them."""

from __future__ import annotations

from kernel.alarm import distance, tone
from models.compiled import compile_machines

MADE = compile_machines((tone, distance))
"""The kernel's own functions and records, as attributes of ``MADE.tone`` and ``MADE.distance``."""
