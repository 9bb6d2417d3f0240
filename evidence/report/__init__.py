"""The report for an assessor: one page, made from the safety case, the sources and the records alone."""
