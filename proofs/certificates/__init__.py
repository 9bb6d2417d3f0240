"""Proofs of the obligations, step by step, and who checked them: cvc5's own checker, and ethos where it is there.

An answer ``unsat`` is believed of two solvers.  A certificate is more: the solver writes down each step, and a
checker that searches for nothing goes through them.
"""
