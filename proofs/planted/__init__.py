"""Protocols with a fault put in on purpose: each is refuted, and the true one is not in the same scope."""
