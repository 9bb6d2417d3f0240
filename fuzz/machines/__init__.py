"""Hypothesis state machines over the transitions that are proved: short counterexamples, shrunk."""
