"""`heisoku simulate`: a line in simulated time, judged by the invariants that are proved, told as record and page."""
