"""Runs that show the proof is not vacuous: every transition fires, and does what it is there for."""
