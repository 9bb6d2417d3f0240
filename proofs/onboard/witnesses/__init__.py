"""Concrete runs of the machines on board, each step of them asserted (witnesses)."""
