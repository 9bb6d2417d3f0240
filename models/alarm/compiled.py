"""The alarm's machines compiled, once for all that use them."""

from __future__ import annotations

from kernel.alarm import distance, network, sections, tone, train_list
from models.compiled import compile_machines

MADE = compile_machines((tone, network, sections, distance, train_list))
"""The kernel's own functions and records, as attributes of ``MADE.tone``, ``MADE.distance`` and ``MADE.train_list``."""
