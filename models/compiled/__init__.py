"""The machines on board as machine code: the kernel's own source, rewritten mechanically for numba.

For simulations of very many cycles. ``tests/onboard/test_agreement.py`` holds it to CPython, function by function.
"""

from models.compiled.machines import NotCompilable, compile_machines
from models.compiled.records import packed, tuple_class, unpacked

__all__ = ["NotCompilable", "compile_machines", "packed", "tuple_class", "unpacked"]
