"""Faults planted in the kernel, to see whether a campaign finds what is there to be found."""
