"""The running train as it is: each file one machine of ``kernel.onboard`` in its world, and what is assumed there."""
