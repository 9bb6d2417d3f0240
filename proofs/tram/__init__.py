"""What is claimed of the tram system (paper 002)."""
