"""How long a simulated run may be, in hours: apart from what simulates, which takes long to load."""

LEAST_HOURS, MOST_HOURS = 0.01, 240.0
