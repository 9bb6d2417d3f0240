"""Traffic by the million: faults as data, and a compiled driver that draws for each trace what happens next.

``faults`` and ``distributions`` say what can go wrong and how often; ``places`` and ``tables`` tell compiled code
where everything lies; ``words`` to ``driver`` are the driver, each of them compiled; ``runs`` runs it.
"""
