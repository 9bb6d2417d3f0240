"""Attacks by names, calls and the order of statements; what the heads say is told in ``attacks.py``."""

from __future__ import annotations

TEXTS = '''
## local_unset_on_one_path: refused
def f(a: bool) -> int:
    if a:
        LIMIT = 5
    return LIMIT  # here

## local_unset_in_a_nested_branch: refused
def f(a: bool, b: bool) -> int:
    if a:
        LIMIT = 5
    else:
        if b:
            LIMIT = 6
    return LIMIT  # here

## local_read_before_it_is_set: refused
def f(a: int) -> int:
    b = LIMIT + a  # here
    LIMIT = 1
    return b + LIMIT

## local_of_the_name_of_what_it_calls: refused
def helper(a: int) -> int:
    return a + 1
def f(a: int) -> int:
    helper = helper(a)  # here
    return helper

## annotation_makes_a_local: refused
def f(a: int) -> int:
    LIMIT: int  # here
    return LIMIT + a

## set_on_every_path
def f(a: bool, b: int) -> int:
    if a:
        LIMIT = b
    else:
        LIMIT = 2 * b
    return LIMIT

## returned_where_it_is_not_set
def f(a: bool, b: int) -> int:
    if a:
        LIMIT = b
    else:
        return 0
    return LIMIT

## closure_variable_with_a_global_of_its_name: refused
def made(LIMIT: int):
    def inner(x: int) -> bool:  # here
        return x < LIMIT
    return inner
f = made(10)

## closure_variable_in_a_called_function: refused
def made(LIMIT: int):
    def inner(x: int) -> bool:  # here
        return x < LIMIT
    return inner
inner = made(10)
def f(x: int) -> bool:
    return inner(x)

## decorated_without_telling: refused
def negated(function):
    def f(x: int) -> bool:  # here
        return not function(x)
    return f
@negated
def f(x: int) -> bool:
    return x < LIMIT

## walrus: refused
def f(a: int) -> int:
    return (b := a + 1) + b  # here

## default_evaluated_once
MOST = 3
def helper(a: int, b: int = MOST) -> int:
    return a + b
MOST = 40
def f(a: int) -> int:
    return helper(a) + MOST

## default_in_a_list: refused
def helper(a: int, b: list = []) -> int:  # here
    return a
def f(a: int) -> int:
    return helper(a)

## arguments_as_a_tuple: refused
def helper(*each: int) -> int:  # here
    return 1
def f(a: int) -> int:
    return helper(a, a)

## arguments_by_any_name: refused
def helper(**each: int) -> int:  # here
    return 1
def f(a: int) -> int:
    return helper(a=a)

## positional_only_by_name: refused
def helper(a: int, /) -> int:
    return a
def f(a: int) -> int:
    return helper(a=a)  # here

## keyword_only_by_place: refused
def helper(*, a: int) -> int:
    return a
def f(a: int) -> int:
    return helper(a)  # here

## lambda_bound_late: refused
def f(a: int) -> bool:
    return all(g() == a for g in (lambda: x for x in (1, 2)))  # here

## generator_as_a_value: refused
def f(a: int) -> bool:
    each = (x for x in (a, 1))  # here
    return any(x > 0 for x in each) and any(x > 0 for x in each)

## generator_of_a_loop: refused
def f(a: int) -> bool:
    return any(x > 0 for x in (y for y in (a, 1)))  # here

## all_by_the_name_of_any
any = all
def f(a: int, b: int) -> bool:
    return any(x > 0 for x in (a, b))

## function_by_the_name_of_any
def any(each: bool) -> bool:
    return not each
def f(a: int) -> bool:
    return any(a > 0)

## parameter_by_the_name_of_any: refused
def f(any: int) -> bool:
    return any(x > 0 for x in (any, 1))  # here

## function_by_the_name_of_replace
def replace(a: int, b: int) -> int:
    return a - b
def f(a: int, b: int) -> int:
    return replace(a, b)

## function_defined_twice
def helper(a: int) -> int:
    return a + 1
def helper(a: int) -> int:
    return a - 1
def f(a: int) -> int:
    return helper(a)

## function_by_another_name
def helper(a: int) -> int:
    return a + 1
other = helper
def helper(a: int) -> int:
    return a - 1
def f(a: int) -> int:
    return helper(a) * other(a)

## function_defined_under_a_condition
if LIMIT > 2:
    def helper(a: int) -> int:
        return a + 1
else:
    def helper(a: int) -> int:
        return a - 1
def f(a: int) -> int:
    return helper(a)

## function_within: refused
def f(a: int) -> int:
    def inner(b: int) -> int:  # here
        return b + a
    return inner(1)

## global_declared: refused
def f(a: int) -> int:
    global LIMIT  # here
    return LIMIT + a

## deleted: refused
def f(a: int) -> int:
    b = a
    del b  # here
    return LIMIT

## loop_variable_shadows_a_parameter
def f(a: int, b: int) -> int:
    return a if any(a == 1 for a in (b, 2)) else b

## loop_variable_shadows_and_is_looped_over
def f(a: int, b: int) -> bool:
    a = (a, b)
    return all(a > 0 for a in a)

## loop_variable_read_before_it_is_bound: refused
def f(x: int, y: int) -> bool:
    return any(x == y for x in (x, 1) if y > 0 for y in (x, 2))  # here

## loop_variable_looped_over_before_it_is_bound: refused
def f(a: int, y: int) -> bool:
    return any(x > y for z in (a, 1) for x in (y, z) for y in (1, 2))  # here

## loop_variable_read_before_it_is_bound_with_a_global: refused
def f(a: int) -> bool:
    return any(x == LIMIT for x in (a, LIMIT) if LIMIT > 1 for LIMIT in (x, 2))  # here

## loop_variable_after_the_loop: refused
def f(a: int) -> int:
    return LIMIT + x if any(x > 0 for x in (a, 1)) else 0  # here

## first_range_is_of_the_outside
def f(a: int, x: int) -> bool:
    return any(x > 1 for x in (x, a))

## comprehension_keeps_the_value_of_its_time
def f(a: int, b: int) -> bool:
    kept = {x for x in (1, 2, 3) if x > a}
    a = b
    return a in kept

## match: refused
def f(a: int) -> int:
    match a:  # here
        case 1:
            return 1
        case _:
            return 0

## starred_target: refused
def f(a: int, b: int) -> int:
    first, *rest = (a, b, a)  # here
    return first

## starred_argument: refused
def helper(a: int, b: int) -> int:
    return a - b
def f(a: int, b: int) -> int:
    return helper(*(b, a))  # here

## loop_with_else: refused
def f(a: int) -> int:
    for x in (a, 1):  # here
        if x > 3:
            return 1
    else:
        return 2
    return 3

## target_twice
def f(a: int, b: int) -> int:
    x, x = a, b
    return x

## targets_exchanged
def f(a: int, b: int) -> int:
    (x, y), z = (a, b), a
    x, y = y, x
    return x * 100 - y * 10 + z

## targets_from_either_branch
def f(a: int, b: int) -> int:
    x, y = (a, b) if a < b else (b, a)
    return x - 2 * y

## two_targets: refused
def f(a: int) -> int:
    x = y = a  # here
    return x + y

## name_of_the_module: refused
def f(a: int) -> bool:
    return __debug__ and a > 0  # here

## mangled_name: refused
__most = 3
_Own__most = 4
class Own:
    def method(a: int) -> int:
        return a + __most  # here
def f(a: int) -> int:
    return Own.method(a)

## expression_without_use: refused
def f(a: int) -> int:
    LIMIT  # here
    return a

## docstring_in_the_middle
def f(a: int) -> int:
    """Returns it."""
    b = a
    "says nothing"
    return b

## early_returns
def f(a: int, b: int) -> int:
    if a < 0:
        if b < 0:
            return 1
        a = 5
    elif b < 0:
        return 2
    else:
        b = a
    if a == b:
        return 3
    return a - b

## narrowed_by_a_negated_test
def f(a: int) -> int:
    x = None if a == 0 else a
    if not (x is not None and x > 2):
        return -1
    return x

## narrowed_then_set_again
def f(a: int, b: int) -> int:
    x = None if a == 0 else a
    if x is None:
        x = b
    return x

## assert_with_a_message: needs
def f(a: int) -> int:
    assert a > 0, "more"
    return a

## called_in_its_own_arguments
def helper(a: int, b: int) -> int:
    return a - 2 * b
def f(a: int, b: int) -> int:
    return helper(b=a, a=helper(a, -b))

## called_with_a_record_of_either_branch
@dataclass(frozen=True)
class Part:
    a: int
    b: int
def swapped(part: Part) -> Part:
    if part.a < part.b:
        return Part(b=part.a, a=part.b)
    return part
def f(a: int, b: int) -> int:
    part = swapped(Part(a, b))
    if part.a == a:
        part = replace(part, b=0)
    other = swapped(part)
    return other.a * 100 + other.b
'''
