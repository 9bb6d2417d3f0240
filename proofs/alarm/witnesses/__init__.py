"""Concrete runs of the theories of the approach alarm, with what they show asserted."""
