"""Every node that the syntax tree of the running Python can have, and a function that shows what the lifter does of it.

An accepted function agrees with CPython; a refused one is refused at the line marked ``# here``.  A text stands once
for all the nodes named with it.
"""

from __future__ import annotations

ACCEPTED: dict[str, str] = {
    "Module FunctionDef arguments arg Return Load": "def f(a: int, b: int) -> int:\n    return b",
    "Constant Expr Assign Name Store": 'def f(a: int) -> int:\n    """Text."""\n    b = 5\n    return b',
    "AnnAssign": "def f(a: int) -> int:\n    b: int = a\n    return b",
    "If": (
        "def f(a: int, b: int) -> int:\n    if a < b:\n        return 1\n    elif a == b:\n        b = 3\n    return b"
    ),
    "Assert": "def f(a: int) -> int:\n    assert a > 0\n    return a",
    "BinOp Add Sub Mult": "def f(a: int, b: int) -> int:\n    return a + b * a - b",
    "FloorDiv Mod": "def f(a: int, b: int) -> int:\n    return a // b + a % b",
    "BitOr BitAnd": "def f(a: Flag, b: Flag) -> bool:\n    return a in ({a} | {b}) & {b}",
    "UnaryOp USub Not": "def f(a: int) -> bool:\n    return not -a < 2",
    "BoolOp And Or": "def f(a: bool, b: bool) -> bool:\n    return a and not b or b and not a",
    "IfExp": "def f(a: bool, b: int) -> int:\n    return b if a else 0",
    "Compare Eq NotEq Lt LtE Gt GtE": (
        "def f(a: int, b: int) -> bool:\n    return a < b <= 2 or a > b >= 1 or a == 1 or a != b"
    ),
    "Is IsNot": "def f(a: Ship | None, b: Flag) -> bool:\n    return a is not None and b is Flag.RED",
    "In NotIn Set": "def f(a: int, b: int) -> bool:\n    return a in {1, b} or b not in {a, 2}",
    "Attribute": "def f(a: Slot) -> int:\n    return a.depth",
    "Subscript": "def f(a: Ship, m: Mapping[Ship, int]) -> int:\n    return m[a]",
    "Tuple": "def f(a: int, b: int) -> int:\n    c, d = (b, a)\n    return c - 2 * d",
    "Dict": "def f(a: int, b: int) -> int:\n    return {a: 1, **{b: 2}}[a]",
    "Call keyword": (
        "def g(a: int, b: int) -> int:\n    return a - 2 * b\ndef f(a: int, b: int) -> int:\n    return g(b=a, a=b)"
    ),
    "GeneratorExp comprehension": "def f(a: int, b: int) -> bool:\n    return any(x > 1 for x in (a, b) if x != b)",
    "SetComp": "def f(a: int, b: int) -> bool:\n    return a in {x + 1 for x in (a, b)}",
    "DictComp": "def f(a: int, b: int) -> bool:\n    return {x: x + 1 for x in (a, b)}[a] > b",
}

REFUSED: dict[str, str] = {
    "AugAssign": "def f(a: int) -> int:\n    a += 1  # here\n    return a",
    "Delete Del": "def f(a: int) -> int:\n    del a  # here\n    return 1",
    "Pass": "def f(a: int) -> int:\n    pass  # here\n    return a",
    "For Break Continue": (
        "def f(a: int) -> int:\n    for b in (1, a):  # here\n        if b > 1:\n            break\n        continue\n"
        "    return a"
    ),
    "While": "def f(a: int) -> int:\n    while a < 1:  # here\n        a = a + 1\n    return a",
    "Try ExceptHandler": (
        "def f(a: int) -> int:\n    try:  # here\n        return 1 // a\n    except ZeroDivisionError:\n"
        "        return 0"
    ),
    "TryStar": (
        "def f(a: int) -> int:\n    try:  # here\n        a = 1 // a\n    except* ZeroDivisionError:\n        a = 0\n"
        "    return a"
    ),
    "Raise": "def f(a: int) -> int:\n    raise ValueError  # here",
    "With withitem": "def f(a: int) -> int:\n    with open('x') as b:  # here\n        return a",
    "Match match_case MatchValue MatchAs": (
        "def f(a: int) -> int:\n    match a:  # here\n        case 1:\n            return 1\n        case b:\n"
        "            return b"
    ),
    "MatchSingleton MatchSequence MatchStar MatchMapping MatchClass MatchOr": (
        "def f(a: int) -> int:\n    match a:  # here\n        case None | [1, *_]:\n            return 1\n"
        "        case {1: 2}:\n            return 2\n        case int():\n            return 3\n    return a"
    ),
    "Import alias": "def f(a: int) -> int:\n    import math  # here\n    return a",
    "ImportFrom": "def f(a: int) -> int:\n    from math import tau  # here\n    return a",
    "Global": "def f(a: int) -> int:\n    global LIMIT  # here\n    return LIMIT",
    "Nonlocal": (
        "def f(a: int) -> int:\n    def g() -> int:  # here\n        nonlocal a\n        return a\n    return g()"
    ),
    "ClassDef": "def f(a: int) -> int:\n    class Own:  # here\n        b = 1\n    return a",
    "Lambda": "def f(a: int) -> int:\n    return (lambda: a)()  # here",
    "NamedExpr": "def f(a: int) -> int:\n    return (b := a) + b  # here",
    "List": "def f(a: int) -> bool:\n    return a in [1, 2]  # here",
    "ListComp": "def f(a: int) -> bool:\n    return a in [b for b in (1, a)]  # here",
    "Slice": "def f(a: int, b: int) -> bool:\n    return (a, b)[0:1] == (a,)  # here",
    "Starred": "def f(a: int, b: int) -> bool:\n    return a in (*(1, b), 2)  # here",
    "JoinedStr FormattedValue": "def f(a: int) -> bool:\n    return f'{a}' == '1'  # here",
    "Yield": "def f(a: int) -> int:\n    b = yield a  # here\n    return a",
    "YieldFrom": "def f(a: int) -> int:\n    b = yield from (a,)  # here\n    return a",
    "AsyncFunctionDef Await": "async def f(a: int) -> int:  # here\n    return await a",
    "AsyncFor AsyncWith": (
        "async def f(a: int) -> int:  # here\n    async with a as b:\n        async for c in b:\n            return c"
    ),
    "UAdd": "def f(a: int) -> int:\n    return +a  # here",
    "Invert": "def f(a: int) -> int:\n    return ~a  # here",
    "Div": "def f(a: int) -> int:\n    return a / 2  # here",
    "Pow": "def f(a: int) -> int:\n    return a ** 2  # here",
    "MatMult": "def f(a: int) -> int:\n    return a @ a  # here",
    "LShift": "def f(a: int) -> int:\n    return a << 1  # here",
    "RShift": "def f(a: int) -> int:\n    return a >> 1  # here",
    "BitXor": "def f(a: int) -> int:\n    return a ^ 1  # here",
    # From Python 3.12 on.
    "TypeAlias": "def f(a: int) -> int:\n    type B = int  # here\n    return a",
    "TypeVar": "def f[T](a: int) -> int:  # here\n    return a",
    "TypeVarTuple": "def f[*T](a: int) -> int:  # here\n    return a",
    "ParamSpec": "def f[**T](a: int) -> int:  # here\n    return a",
    # From Python 3.14 on.
    "TemplateStr Interpolation": "def f(a: int) -> bool:\n    return t'{a}' == a  # here",
}

OTHER_MODES: dict[str, tuple[str, dict[str, object]]] = {
    "Expression": ("1", {"mode": "eval"}),
    "Interactive": ("1", {"mode": "single"}),
    "FunctionType": ("(int) -> int", {"mode": "func_type"}),
    "TypeIgnore": ("a = 1  # type: ignore", {"type_comments": True}),
}
"""Nodes of other ways to parse than that of a file, and how they come."""

OBSOLETE = {
    *("Num", "Str", "Bytes", "NameConstant", "Ellipsis", "Index", "ExtSlice", "Suite", "AugLoad", "AugStore", "Param"),
    "slice",
}
"""Nodes that ``ast`` still names and no parser makes; Python 3.14 has dropped some."""

ABSTRACT = {
    *("AST", "mod", "stmt", "expr", "expr_context", "boolop", "operator", "unaryop", "cmpop", "pattern"),
    *("excepthandler", "type_ignore", "type_param"),
}
"""What nodes are subclasses of."""
