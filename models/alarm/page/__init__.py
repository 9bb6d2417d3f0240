"""The handset's page: what a worker sees (A7), one HTML file with some minutes of a simulated day in it."""
