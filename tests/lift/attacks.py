"""Functions that set out to be lifted otherwise than CPython runs them.

Each is a module of its own, as text: what it does would not pass ruff or mypy.  The function is ``f``.  One that is
*refused* is refused at the line marked ``# here``; one that *needs* something has an obligation that fails for some
arguments; any other agrees with CPython for all.
"""

from __future__ import annotations

PREAMBLE = """\
from __future__ import annotations
import dataclasses
import enum
from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import KW_ONLY, InitVar, dataclass, field, replace
from enum import Enum, IntEnum
from types import MappingProxyType
from typing import ClassVar, NamedTuple, NewType
from tests.lift.harbour import Berth, Flag, Harbour, Ship, Slot, Tide, Visit
LIMIT = 3
"""

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

## field_left_out_of_comparison: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    b: int = field(compare=False)
def f(a: int, b: int, c: int) -> bool:
    return Part(a, b) == Part(a, c)

## field_left_out_of_hash: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    b: int = field(hash=False)
def f(a: int, b: int) -> bool:
    return Part(a, b) in {Part(a, a)}

## record_compared_by_identity: refused
@dataclass(frozen=True, eq=False)  # here
class Part:
    a: int
def f(a: int) -> bool:
    return Part(a) == Part(a)

## record_with_its_own_equality: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    def __eq__(self, other: object) -> bool:
        return True
    __hash__ = None
def f(a: int, b: int) -> bool:
    return Part(a) == Part(b)

## record_with_its_own_hash: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    def __hash__(self) -> int:
        return id(self)
def f(a: int) -> bool:
    return Part(a) in {Part(a)}

## record_with_its_own_equality_as_a_parameter: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    def __eq__(self, other: object) -> bool:
        return True
    __hash__ = None
def f(a: Part, b: Part) -> bool:
    return a == b

## keyword_only_field_first: refused
@dataclass(frozen=True)  # here
class Part:
    a: int = field(default=1, kw_only=True)
    b: int = 0
def f(a: int) -> int:
    return Part(a).b

## keyword_only_marker: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    _: KW_ONLY
    b: int = 0
def f(a: int) -> int:
    return Part(a, b=a).b

## keyword_only_class: refused
@dataclass(frozen=True, kw_only=True)  # here
class Part:
    a: int
def f(a: int) -> int:
    return Part(a).a

## record_with_its_own_init: refused
@dataclass(frozen=True, init=False)  # here
class Part:
    a: int
    b: int
    def __init__(self, b: int, a: int) -> None:
        object.__setattr__(self, "a", a)
        object.__setattr__(self, "b", b)
def f(a: int, b: int) -> int:
    return Part(a, b).a

## record_with_its_own_init_as_a_constant: refused
@dataclass(frozen=True, init=False)  # here
class Part:
    a: int
    def __init__(self) -> None:
        object.__setattr__(self, "a", 5)
PART = Part()
def f(a: int) -> int:
    return replace(PART, a=a).a

## record_made_by_new: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    def __new__(cls, a: int):
        made = object.__new__(cls)
        return made
def f(a: int) -> int:
    return Part(a).a

## record_that_acts_when_made: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    def __post_init__(self) -> None:
        object.__setattr__(self, "a", 0)
def f(a: int) -> int:
    return Part(a).a

## record_that_can_change: refused
@dataclass  # here
class Part:
    a: int
def f(a: int) -> int:
    return Part(a).a

## field_set_by_no_caller: refused
@dataclass(frozen=True)  # here
class Part:
    a: int = field(default=7, init=False)
    b: int = 0
def f(a: int) -> int:
    return Part(a).b

## argument_that_is_no_field: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    b: InitVar[int] = 0
def f(a: int) -> int:
    return Part(a, a).a

## field_hidden_by_a_property: refused
@dataclass(frozen=True)
class Base:
    a: int
class Part(Base):  # here
    @property
    def a(self) -> int:
        return 5
def f(part: Part) -> int:
    return part.a

## field_read_by_getattribute: refused
@dataclass(frozen=True)  # here
class Part:
    a: int
    def __getattribute__(self, name: str):
        return 5
def f(a: int) -> int:
    return Part(a).a

## field_that_is_a_descriptor: refused
class Doubled:
    def __get__(self, owner, kind=None) -> int:
        return 4 if owner is None else 2
    def __set__(self, owner, value) -> None:
        pass
@dataclass(frozen=True)  # here
class Part:
    a: int = Doubled()
def f(a: int) -> int:
    return Part(a).a

## record_of_another_record: refused
@dataclass(frozen=True)
class Base:
    a: int
@dataclass(frozen=True)  # here
class Part(Base):
    b: int
def f(a: int, b: int) -> int:
    return Part(a, b).b

## class_made_by_a_metaclass: refused
class Meta(type):
    def __call__(cls, a: int):
        return super().__call__(a + 1)
@dataclass(frozen=True)  # here
class Part(metaclass=Meta):
    a: int
def f(a: int) -> int:
    return Part(a).a

## class_constant_by_a_metaclass: refused
class Meta(type):
    def __getattr__(cls, name: str) -> int:
        return 5
class Limits(metaclass=Meta):
    pass
def f(a: int) -> int:
    return a + Limits.most  # here

## enum_with_its_own_equality: refused
class Own(Enum):  # here
    A = 1
    B = 2
    def __eq__(self, other: object) -> bool:
        return True
    def __hash__(self) -> int:
        return 0
def f(a: Own, b: Own) -> bool:
    return a == b

## enum_with_its_own_hash: refused
class Own(Enum):  # here
    A = 1
    B = 2
    def __hash__(self) -> int:
        return 0
def f(a: Own, b: Own) -> bool:
    return a in {b}

## enum_with_an_alias: refused
class Own(Enum):  # here
    A = 1
    B = 1
def f(a: bool) -> bool:
    return (Own.A if a else Own.B) is Own.B

## enum_of_numbers: refused
class Own(IntEnum):  # here
    A = 1
    B = 2
def f(a: Own) -> bool:
    return a == Own.B

## enum_that_is_a_number: refused
class Own(int, Enum):  # here
    A = 1
    B = 2
class Other(int, Enum):
    A = 1
def f(a: bool) -> bool:
    return Own.A in {Own.B}

## enum_of_flags: refused
class Own(enum.Flag):  # here
    A = 1
    B = 2
def f(a: Own) -> bool:
    return a is Own.A or a is Own.B

## enum_member_that_is_a_method: refused
class Own(Enum):
    A = 1
    def late(self) -> bool:
        return True
def f(a: bool) -> bool:
    return Own.A.late()  # here

## named_tuple_with_its_own_equality: refused
class Own(NamedTuple):  # here
    a: Tide
    def __eq__(self, other: object) -> bool:
        return True
    __hash__ = tuple.__hash__
def f(a: Own, b: Own) -> bool:
    return a == b

## named_tuple_with_a_hidden_field: refused
class Base(NamedTuple):
    a: Tide
class Own(Base):  # here
    @property
    def a(self) -> Tide:
        return Tide(0)
def f(a: Own, b: Tide) -> bool:
    return a.a == b

## named_tuple_with_a_property: refused
class Own(NamedTuple):
    a: Tide
    @property
    def b(self) -> Tide:
        return self.a
def f(a: Visit, b: Tide) -> bool:
    return a.b == b  # here

## named_tuple_as_a_tuple: refused
def f(a: Visit, b: Tide, c: Ship) -> bool:
    return a == (b, c)  # here

## named_tuple_by_place: refused
def f(a: Visit, b: Tide) -> bool:
    return a[0] == b  # here

## named_tuple_taken_apart: refused
def f(a: Visit, b: Tide) -> bool:
    tide, ship = a  # here
    return tide == b

## records_of_different_classes: refused
@dataclass(frozen=True)
class One:
    a: int
@dataclass(frozen=True)
class Other:
    a: int
def f(a: int) -> bool:
    return One(a) == Other(a)  # here

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

## match: refused
def f(a: int) -> int:
    match a:  # here
        case 1:
            return 1
        case _:
            return 0

## constant_of_a_class_overridden
class Base:
    most = 3
class Limits(Base):
    most = 4
def f(a: int) -> int:
    return a * Limits.most - Base.most

## constant_of_a_class_by_a_descriptor: refused
class Reading:
    count = 0
    def __get__(self, owner, kind=None) -> int:
        Reading.count += 1
        return Reading.count
class Limits:
    most = Reading()
def f(a: int) -> int:
    return a + Limits.most  # here

## constant_of_a_record
@dataclass(frozen=True)
class Part:
    a: int
    b: int = 7
def f(a: int) -> int:
    return Part(a, a).b + Part.b

## constant_for_the_class_alone: refused
@dataclass(frozen=True)
class Part:
    a: int
    most: ClassVar[int] = 5
def f(a: int) -> int:
    return Part(a).most  # here

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

## records_in_order: refused
@dataclass(frozen=True, order=True)
class Part:
    a: int
def f(a: int, b: int) -> bool:
    return Part(a) < Part(b)  # here

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

## named_tuple_made: refused
def f(a: Tide, b: Ship) -> bool:
    return Visit(a, b).tide == a  # here

## field_that_is_not_there: refused
@dataclass(frozen=True)
class Part:
    a: int
def f(a: int) -> int:
    return replace(Part(a), b=1).a  # here

## replaced_twice
@dataclass(frozen=True)
class Part:
    a: int
    b: int = 7
def f(a: int, b: int) -> int:
    part = Part(a)
    part = replace(part, a=b) if a < b else part
    return part.a * 10 + replace(part, b=part.a).b

## starred_display: refused
def f(a: int, b: int) -> bool:
    return a in (*(a, b), 1)  # here

## starred_set: refused
def f(a: int, b: int) -> bool:
    return a in {*{a, b}, 1}  # here

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

## method_of_a_class
class Own:
    def method(a: int) -> int:
        return a + LIMIT
def f(a: int) -> int:
    return Own.method(a)

## expression_without_use: refused
def f(a: int) -> int:
    LIMIT  # here
    return a

## two_enums_of_one_name: refused
class One:
    class Twin(Enum):
        A = 1
        B = 2
class Other:
    class Twin(Enum):
        A = 1
        B = 2
def f(a: bool) -> bool:
    return One.Twin.A == Other.Twin.A  # here

## two_enums_of_one_name_in_loops: refused
class One:
    class Double(Enum):
        A = 1
class Other:
    class Double(Enum):
        A = 1
def f(a: bool) -> bool:
    return any(a for b in (One.Double.A,) for c in {Other.Double.A} if b == c)  # here

## field_by_the_name_of_the_test_for_none: refused
@dataclass(frozen=True)  # here
class Part:
    is_none: bool
    a: int
def f(a: Part | None) -> bool:
    return a is not None and a.is_none

## field_by_the_name_of_a_domain: refused
@dataclass(frozen=True)  # here
class Part:
    has: bool
    a: int
def f(m: Mapping[Ship, Part], s: Ship) -> bool:
    return s in m and not m[s].has

## docstring_in_the_middle
def f(a: int) -> int:
    """Returns it."""
    b = a
    "says nothing"
    return b

## formatted: refused
def f(a: int) -> bool:
    return f"{a}" == "1"  # here

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

## records_in_a_set
@dataclass(frozen=True)
class Part:
    a: int
    b: bool
def f(a: int, b: int, c: bool) -> bool:
    return {Part(a, c), Part(b, True)} == {Part(b, c)}

## records_as_keys
@dataclass(frozen=True)
class Part:
    a: int
    b: bool
def f(a: int, b: int, c: bool) -> int:
    return {Part(a, c): 1, Part(b, True): 2}.get(Part(b, c), 3)

## record_with_an_optional_field_as_a_key: refused
@dataclass(frozen=True)
class Part:
    a: int | None
def f(a: int, b: int) -> bool:
    return Part(None if a > 0 else a) in {Part(b)}  # here

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

## methods_of_a_map_with_arguments: refused
def f(m: Mapping[Ship, int]) -> bool:
    return any(v > 0 for v in m.values(1))  # here

## asked_for_its_type: refused
def f(a: int) -> bool:
    return isinstance(a, int)  # here
'''


def texts() -> dict[str, tuple[str, str]]:
    """Return each attack by its name: what must come of it, and its module."""
    found = {}
    for part in TEXTS.split("\n## ")[1:]:
        head, body = part.split("\n", 1)
        name, _, verdict = head.partition(": ")
        assert verdict in ("", "refused", "needs"), head
        assert name not in found, name
        found[name] = (verdict or "agrees", PREAMBLE + body.rstrip() + "\n")
    return found
