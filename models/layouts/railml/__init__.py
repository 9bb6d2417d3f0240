"""railML 3: track from the topology, points from switches, boundaries from detectors and signals, routes."""

from models.layouts.railml.importing import import_railml

__all__ = ["import_railml"]
