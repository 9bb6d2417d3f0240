"""railML 2 and 3: track, points from switches, boundaries from detectors and signals, routes as told or derived."""

from models.layouts.railml.importing import import_railml

__all__ = ["import_railml"]
