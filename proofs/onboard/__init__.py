"""What is claimed of the machines on board and the radio link: a theory a file."""
