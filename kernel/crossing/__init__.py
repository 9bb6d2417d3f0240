"""The level crossing: warned long enough before every train, by radio ranging or by the start point (X1 to X6)."""
