"""Concrete runs of the level crossing in which every transition has its effect."""
