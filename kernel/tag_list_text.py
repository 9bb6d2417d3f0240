"""A tag list as text, and what a text says: the centre writes one for each route, a unit reads what it keeps (T4).

A line for each thing said: what it is, and the names it is of, with a tab before each; in a relation they stand two
by two.  Every text says something, and what is no such line says nothing: whether it is the text that was meant is the
centre's to compare.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from kernel.layout import Layout
from kernel.names import Block, Point, Position, Route, Tag, TagList
from kernel.tag_list import TagLists

START, COVERS, OVERLAP, WAY = "start", "covers", "overlap", "way"
NEEDS, RELEASED_AFTER, FIRST_TAG, TAG_AFTER = "needs", "released after", "first tag", "tag after"
ESCAPED = (("%", "%25"), ("\t", "%09"), ("\n", "%0A"))
"""What cannot stand in a name, and what stands for it."""

Line = tuple[str, tuple[str, ...]]
"""What is said, and of which names."""


def written(layout: Layout, route: Route) -> TagList:
    """Write down all that a unit will use of a route (T4)."""
    return TagList(
        "\n".join(
            (
                line(START, [layout.start[route]]),
                line(COVERS, sorted(layout.covers[route])),
                line(OVERLAP, sorted(layout.overlap[route])),
                line(WAY, two_by_two(layout.way[route].items())),
                line(NEEDS, two_by_two(layout.needs[route].items())),
                line(RELEASED_AFTER, two_by_two(layout.released_after[route].items())),
                line(FIRST_TAG, [layout.first_tag[route]] if route in layout.first_tag else []),
                line(TAG_AFTER, two_by_two(layout.tag_after.get(route, {}).items())),
            )
        )
    )


def with_tag_lists(layout: Layout) -> Layout:
    """Give the same layout, with a list for each of its routes (T4)."""
    return replace(layout, tag_list={route: written(layout, route) for route in layout.routes})


def what_they_say(tag_lists: Iterable[TagList]) -> TagLists:
    """Read lists: all that a unit knows of the routes that it was sent (T4)."""
    said = {tag_list: lines(tag_list) for tag_list in tag_lists}
    start = {text: frozenset(map(Block, named(read, START))) for text, read in said.items()}
    covers = {text: frozenset(map(Block, named(read, COVERS))) for text, read in said.items()}
    overlap = {text: frozenset(map(Block, named(read, OVERLAP))) for text, read in said.items()}
    return TagLists(
        start={text: block for text in said for block in start[text]},
        covers=covers,
        overlap=overlap,
        claims={text: start[text] | covers[text] | overlap[text] for text in said},
        way={text: {Block(a): Block(b) for a, b in pairs(read, WAY)} for text, read in said.items()},
        needs={text: {Point(a): Position(b) for a, b in pairs(read, NEEDS)} for text, read in said.items()},
        released_after={
            text: {Block(a): Block(b) for a, b in pairs(read, RELEASED_AFTER)} for text, read in said.items()
        },
        first_tag={text: Tag(name) for text, read in said.items() for name in named(read, FIRST_TAG)},
        tag_after={text: {Tag(a): Tag(b) for a, b in pairs(read, TAG_AFTER)} for text, read in said.items()},
    )


def line(what: str, names: Sequence[str]) -> str:
    """Write one line (T4)."""
    return "\t".join((what, *map(escaped, names)))


def two_by_two(relation: Iterable[tuple[str, str]]) -> list[str]:
    """Give the names of a relation, each with its own behind it (T4)."""
    return [name for pair in sorted(relation) for name in pair]


def escaped(name: str) -> str:
    """Write a name without what ends one (T4)."""
    for plain, stands_for_it in ESCAPED:
        name = name.replace(plain, stands_for_it)
    return name


def unescaped(text: str) -> str:
    """Read a name (T4)."""
    for plain, stands_for_it in reversed(ESCAPED):
        text = text.replace(stands_for_it, plain)
    return text


def lines(tag_list: TagList) -> tuple[Line, ...]:
    """Read the lines of a list (T4)."""
    parts = [each.split("\t") for each in tag_list.split("\n")]
    return tuple((what, tuple(map(unescaped, names))) for what, *names in parts)


def named(read: Iterable[Line], what: str) -> tuple[str, ...]:
    """Give the names that the lines of one kind name (T4)."""
    return tuple(name for said, names in read if said == what for name in names)


def pairs(read: Iterable[Line], what: str) -> list[tuple[str, str]]:
    """Give the names of a relation, two by two (T4)."""
    names = named(read, what)
    return list(zip(names[0::2], names[1::2], strict=False))
