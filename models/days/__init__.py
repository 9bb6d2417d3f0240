"""Whole days of the three systems beside the tag-based one, with faults: crossing, tram and track-worker alarm."""
