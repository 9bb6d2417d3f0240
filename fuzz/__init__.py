"""Campaigns: faults drawn by the million, run through the compiled kernel, with the invariants as oracles."""

# A process that serves other machines loads this first; it must see all sources before it loads one of them.
from models import sources as sources
