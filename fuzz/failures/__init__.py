"""A failure: its trace, replayed in plain CPython, made short, named by its cause, and shown as a page."""
