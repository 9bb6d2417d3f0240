"""What always holds: safety claims, and the lemmas that carry their induction."""
