"""Attacks by truths, numbers, none, tuples, sets and maps; what the heads say is told in ``attacks.py``."""

from __future__ import annotations

TEXTS = """
## set_written_into_one_key: refused
def f(c: int, a: int, b: int) -> int:
    m = {c: x for x in frozenset({a, b})}  # here
    return m[c]

## set_display_written_into_one_key: refused
def f(c: int, a: int, b: int) -> int:
    m = {c: y for y in {a, b}}  # here
    return m[c]

## set_written_into_a_key_of_another_loop: refused
def f(c: int, a: int, b: int) -> int:
    m = {x: y for x in (c, c + 1) for y in {a, b}}  # here
    return m[c]

## set_constant_written_into_one_key: refused
SOME = frozenset({1, 2})
def f(c: int) -> int:
    m = {c: x for x in SOME}  # here
    return m[c]

## map_written_into_one_key: refused
def f(c: int, a: int, b: int) -> int:
    m = {c: x for x in {a: 1, b: 2}.values()}  # here
    return m[c]

## tuple_written_into_one_key
def f(c: int, a: int, b: int) -> int:
    m = {c: x for x in (a, b)}
    return m[c]

## tuple_of_pairs_into_a_map
def f(a: int, b: int, c: int) -> int:
    m = {key: value for key, value in ((a, 1), (b, 2), (c, 3))}
    return m[a] * 100 + m[b] * 10 + m[c]

## set_with_each_key_named
def f(a: int, b: int) -> int:
    m = {x: x * x for x in {a, b}}
    return m[a] - m[b]

## true_is_one: refused
def f(a: int) -> bool:
    return True == a  # here

## true_among_numbers: refused
def f(a: int) -> bool:
    return a in (1, True)  # here

## true_in_a_set_of_numbers: refused
def f(a: bool, b: int) -> bool:
    return a in {b}  # here

## true_as_a_key_among_numbers: refused
def f(a: bool, b: int) -> bool:
    m = {b: 1} | {True: 2}
    return m.get(b) == 2  # here

## calculated_with_a_truth: refused
def f(a: bool) -> int:
    return a + 1  # here

## negated_truth: refused
def f(a: bool) -> int:
    return -a  # here

## inverted: refused
def f(a: int) -> int:
    return ~a  # here

## identity_of_numbers: refused
def f(a: int, b: int) -> bool:
    return a + b is b + a  # here

## identity_with_a_literal: refused
def f(a: int) -> bool:
    return (a, 1) is (a, 1)  # here

## identity_of_flags
def f(a: Flag, b: bool) -> bool:
    return a is (Flag.RED if b else Flag.GREEN)

## none_on_the_left: refused
def f(a: Ship | None) -> bool:
    return None is a  # here

## optional_names_compared
def f(a: Ship | None, b: Ship | None) -> bool:
    return a == b and a is not None or a != b and (a is None) != (b is None)

## floored_below_zero
def f(a: int, b: int) -> int:
    return -a // b * b + a % -b if b != 0 else -7 // 2 - -7 % 2

## divided_by_zero: needs
def f(a: int, b: int) -> int:
    return a // b + a % b

## minus_of_what_is_not_there: needs
def f(m: Mapping[Ship, int], s: Ship) -> int:
    return -m[s]

## divided: refused
def f(a: int, b: int) -> bool:
    return a / b > 1  # here

## raised_to_a_power: refused
def f(a: int) -> int:
    return a ** 2  # here

## chain_of_comparisons
def f(a: int, b: int, c: int) -> bool:
    return a < b > c != a

## chain_of_equalities
def f(a: Ship | None, b: Ship | None, c: Ship) -> bool:
    return a == b == c or a != b != c

## chain_with_membership
def f(a: int, b: int) -> bool:
    return a in (a, b) != (b, a)

## chain_stops_where_it_fails
def f(a: int, m: Mapping[Ship, int], s: Ship) -> bool:
    return s in m and 0 < a <= m[s]

## key_repeated_in_a_display
def f(a: int, b: int) -> int:
    m = {a: 1, b: 2, a: 3}
    return m[a] * 10 + m[b]

## entries_before_and_after_a_map
def f(a: int, b: int) -> int:
    m = {a: 1, **{b: 2, 1: 5}, 2: 3}
    return m[a] * 100 + m[b] * 10 + m.get(1, 0) + m.get(2, 0)

## two_maps_in_one
def f(a: int, b: int) -> int:
    m = {**{a: 1, 1: 2}, **{b: 3}}
    return m[a] * 100 + m[b] * 10 + m[1]

## maps_united
def f(a: int, b: int) -> int:
    m = {a: 1, b: 2} | {b: 3, 1: 4}
    return m[a] * 10 + m[b] + m[1]

## difference_of_what_is_not_in_it
def f(a: int, b: int, c: int) -> bool:
    s = {a, b} - {c}
    return s == {a} or s <= {b} or c in s

## sets_of_squares
def f(a: int, b: int) -> bool:
    return {x * x for x in (a, b)} == {a * a}

## symmetric_difference: refused
def f(a: int, b: int) -> bool:
    return a in {a} ^ {b}  # here

## proper_subset: refused
def f(a: int, b: int) -> bool:
    return {a} < {a, b}  # here

## counted: refused
def f(a: int, b: int) -> int:
    return len({a, b})  # here

## largest_of_nothing: refused
def f(a: int) -> int:
    return max(x for x in (a, 1) if x > 3)  # here

## least: refused
def f(a: int, b: int) -> int:
    return min(a, b)  # here

## summed: refused
def f(a: int, b: int) -> int:
    return sum((a, b))  # here

## sorted: refused
def f(a: int, b: int) -> bool:
    return sorted({a, b}) == (a, b)  # here

## converted: refused
def f(a: bool) -> int:
    return int(a)  # here

## truth_of_a_number_asked: refused
def f(a: int) -> bool:
    return bool(a)  # here

## names_in_order_of_letters: refused
def f(a: Ship, b: Ship) -> bool:
    return a < b  # here

## tuples_in_order: refused
def f(a: int, b: int) -> bool:
    return (a, b) < (b, a)  # here

## none_among_listed
def f(a: int) -> bool:
    y = None if a > 0 else a
    return y in (None, 5)

## none_in_a_set: needs
def f(a: int) -> bool:
    y = None if a > 0 else a
    return y in {None, 1}

## none_in_a_constant_set: refused
SOME = frozenset({None, 1})
def f(a: int) -> bool:
    y = None if a > 0 else a
    return y in SOME  # here

## none_as_a_constant_key: refused
SOME = {None: 1, 2: 2}
def f(a: int) -> bool:
    y = None if a > 0 else a
    return y in SOME  # here

## none_within_an_element: needs
def f(y: Ship | None, b: int) -> bool:
    return (y, b) in {(y, b)}

## none_within_a_key: needs
def f(y: Ship | None, b: int) -> bool:
    return (y, b) in {(y, b): 1}

## none_within_an_element_of_a_comprehension: needs
def f(y: Ship | None, b: int) -> bool:
    return (y, b) in {(y, x) for x in (b, 1)}

## none_within_a_key_of_a_comprehension: needs
def f(y: Ship | None, b: int) -> bool:
    return (y, b) in {(y, x): x for x in (b, 1)}

## none_from_values: needs
def f(m: Mapping[Ship, Berth | None]) -> bool:
    return None in {b for b in m.values()}

## none_in_every_value
def f(m: Mapping[Ship, Berth | None], b: Berth) -> bool:
    return any(x == b or x is None for x in m.values())

## number_as_a_condition: refused
def f(a: int) -> int:
    if a:  # here
        return 1
    return 0

## optional_as_a_condition: refused
def f(a: Ship | None) -> bool:
    return not a  # here

## optional_truth_as_a_condition: refused
def f(a: bool) -> bool:
    b = None if a else True
    return True if b else False  # here

## map_as_a_condition: refused
def f(m: Mapping[Ship, int]) -> bool:
    return True if m else False  # here

## alternative_value: refused
def f(a: int, b: int) -> int:
    return a or b  # here

## numbers_in_any: refused
def f(a: int, b: int) -> bool:
    return any(x for x in (a, b))  # here

## numbers_in_all_by_a_tuple: refused
def f(a: bool, b: bool) -> bool:
    return all((a, b))  # here

## starred_display: refused
def f(a: int, b: int) -> bool:
    return a in (*(a, b), 1)  # here

## starred_set: refused
def f(a: int, b: int) -> bool:
    return a in {*{a, b}, 1}  # here

## item_beyond_the_end: refused
def f(a: int, b: int) -> int:
    return (a, b)[2]  # here

## item_from_the_end: refused
def f(a: int, b: int) -> int:
    return (a, b)[-1]  # here

## item_by_a_truth: refused
def f(a: int, b: int) -> int:
    return (a, b)[True]  # here

## counter_united: refused
SOME = Counter({1: 2, 2: 1})
def f(a: int) -> bool:
    return (SOME | {1: 1}).get(1) == 1  # here

## counter_behind_a_proxy: refused
SOME = MappingProxyType(Counter({1: 2, 2: 1}))
def f(a: int) -> bool:
    return (SOME | {1: 1}).get(1) == 1  # here

## map_with_a_default: refused
SOME = defaultdict(int)
def f(a: int) -> int:
    return SOME[a]  # here

## set_of_another_class: refused
class Everything(frozenset):
    def __contains__(self, item: object) -> bool:
        return True
SOME = Everything({1})
def f(a: int) -> bool:
    return a in SOME  # here

## changing_set_as_a_constant: refused
SOME = {1, 2}
def f(a: int) -> bool:
    return a in SOME  # here

## formatted: refused
def f(a: int) -> bool:
    return f"{a}" == "1"  # here

## default_is_not_for_a_value_of_none
def f(a: int) -> int:
    m = {1: None, 2: 5}
    v = m.get(a, 9)
    return 0 if v is None else v

## entry_of_none_put_over
def f(a: int, b: int) -> int:
    m = {1: 3, 2: 5} | {a: None if b > 0 else b}
    v = m.get(1, 9)
    return 100 if v is None else v

## maps_with_none_compared
def f(a: int, b: int) -> bool:
    return {a: None, b: 1} == {b: 1, a: None if a < 2 else a}

## map_with_an_entry_of_none_and_the_empty_map
def f(a: int) -> bool:
    return {a: None} == {} or {a: None}.get(a, 3) is None

## maps_compared_by_entries
def f(a: int, b: int) -> bool:
    return {a: 1, b: 2} == {b: 2, a: 1}

## methods_of_a_map_with_arguments: refused
def f(m: Mapping[Ship, int]) -> bool:
    return any(v > 0 for v in m.values(1))  # here

## asked_for_its_type: refused
def f(a: int) -> bool:
    return isinstance(a, int)  # here
"""
