"""What is claimed of the approach alarm for track workers (paper 004)."""
