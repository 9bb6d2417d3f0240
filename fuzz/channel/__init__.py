"""The radio between machines, played against: what a channel and a stranger can do to telegrams (T11)."""
