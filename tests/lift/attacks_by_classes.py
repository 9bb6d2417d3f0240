"""Attacks by records, enums, named tuples and other classes; what the heads say is told in ``attacks.py``."""

from __future__ import annotations

TEXTS = """
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

## records_in_order: refused
@dataclass(frozen=True, order=True)
class Part:
    a: int
def f(a: int, b: int) -> bool:
    return Part(a) < Part(b)  # here

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

## method_of_a_class
class Own:
    def method(a: int) -> int:
        return a + LIMIT
def f(a: int) -> int:
    return Own.method(a)

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
"""
