"""The whole system in simulated time: centre, trains with their units and sensors, radio, terminals, and the truth.

Every decision is the kernel's own: what happens on the line is a step of ``models.world`` that the world must allow,
and on board the kernel's machines run in every cycle of 100 ms.  Trains lie in millimetres on the rails of a file
(``models.concrete``).  Time is simulated, chance comes from a seed, and nothing reads a clock: the same seed gives the
same record.
"""
