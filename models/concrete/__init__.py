"""A train on real track: cars, antennas and tags at positions in mm, held against the abstract world step by step."""
