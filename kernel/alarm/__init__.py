"""The approach alarm for track workers (paper 004): what the worker's handset and the central server decide.

Supplementary protection on lines without track circuits.  Trains are known by GPS and by the traffic
display; whatever is not known is told as a fault or an alarm, never as the normal tone.
"""
