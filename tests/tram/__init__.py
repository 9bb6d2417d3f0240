"""The tram system (paper 002)."""
