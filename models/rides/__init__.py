"""Rides: many trains with faulty sensors, run through the compiled machines on board, the truth beside them.

What is proved of the machines is looked at here on concrete trains: whether the models keep within the
assumptions, and whether monitors fire where they do not.
"""
