"""Evidence for an assessor: the safety case as data, and the records that commands leave."""
