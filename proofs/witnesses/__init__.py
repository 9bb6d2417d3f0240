"""Runs that show the proof is not vacuous: every transition fires, and does what it is there for.

``proofs.witnesses.registry.WITNESSES`` has them all; ``python -m proofs.witnesses`` replays them.
"""
