"""The lifter's second target: kernel, world and invariants as machine code, from the source that is proved and run.

``domains`` numbers the identifiers of a site; ``memory`` lays a state out in words; ``values`` and
``reading`` evaluate the source text to what is to be computed; ``emitter`` and ``native`` make code of it.
"""
