"""What is claimed of the level crossing, a file a machine."""
