"""States that no run need lead to, and events in them, by the million: counterexamples to induction.

Every invariant holds in such a state, so no step of the sound kernel may break one.  ``leaves`` says where
everything of a state lies, ``states`` changes it in a few places, ``events`` draws what happens then, and
``confirming`` asks CPython whether what came of it is so.
"""
