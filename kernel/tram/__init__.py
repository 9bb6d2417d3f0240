"""Tram traffic management by GPS (paper 002): a driver's aid; what is not known counts as present (G1 to G7)."""
