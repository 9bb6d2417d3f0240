"""The abstract world of the proof: trains on track, terminals, and the radio between them."""
