"""The world of the trams: what the proofs assume, and days of a line on which trams bunch (G1 to G7)."""
