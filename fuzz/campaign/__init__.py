"""Campaigns: batches over many processes, what they came to in one folder, and where to look next.

``campaign`` runs one; ``pool`` and ``dask`` are the processes; ``store`` keeps what is finished;
``guidance`` weighs what is drawn next; ``view`` and ``summary`` show it; ``command`` is `heisoku fuzz`.
"""
