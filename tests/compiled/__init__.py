"""Machines compiled, and kept."""
