"""The world that the kernel is embedded in."""
