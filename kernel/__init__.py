"""The safety kernel: small pure machines, standard library only."""
