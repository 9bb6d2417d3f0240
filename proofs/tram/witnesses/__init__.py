"""Concrete runs of the theories of the trams, with what they show asserted."""
