"""The machines on board as machine code: the kernel's own source, rewritten mechanically for numba.

For simulations of very many cycles. ``tests/onboard/test_agreement.py`` holds it to CPython, function by function, and
``tests/alarm/test_compiled.py`` machines with maps.

    made = compile_machines([tone, distance])       # kernel modules; whatever they call comes along
    register = packed(REGISTER)                     # a record; its maps and sets by its fields' types
    made.tone.tone(register, packed(handset))       # a member's number; unpacked(found, Tone) is the member

Names, as of trains, are texts in operation and numbers here: give ``packed`` records whose maps have ints for keys.
A ``Map[K, V]`` is a ``numba.typed.List`` of pairs (K, V), a ``frozenset[T]`` one of T.  Within ``numba.njit``, with
``ITEM = compiled_type(Map[Train, Known]).item_type`` as a global: ``List.empty_list(ITEM)``,
``append((number, record))``, and ``trains[i] = (number, record)`` to change one in place.  Records are made there by
``made.tone.Known(fix, display)`` or ``tuple_class(Known)``, every field in order.  Known are ``any`` and ``all`` over
``some_map.items()`` with conditions, ``key in some_map``, ``some_map[key]``, ``some_map | {key: value}`` and
``{key: f(value) for key, value in some_map.items() if ...}``; whatever else is refused with its file and line.  Two
maps are never compared: their order would count.
"""

from models.compiled.kept import compiled
from models.compiled.machines import NotCompilable, compile_machines
from models.compiled.records import compiled_type, packed, tuple_class, unpacked, unpacking

__all__ = [
    "NotCompilable",
    "compile_machines",
    "compiled",
    "compiled_type",
    "packed",
    "tuple_class",
    "unpacked",
    "unpacking",
]
