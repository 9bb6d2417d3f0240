"""A tag list as text, and what a text says: the centre writes one for each route, a unit reads what it keeps (T4).

A line for each thing said: its name and the names it is of, with a tab before each.  Names that follow each
other, of blocks or of tags, stand in their order.  Every text says something, and what is no such line says
nothing: whether it is the text that was meant is the centre's to compare.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeVar

from kernel.layout import Layout
from kernel.names import Block, Point, Position, Route, Tag, TagList
from kernel.tag_list import TagLists

Name = TypeVar("Name", bound=str)

START, COVERS, OVERLAP, WAY = "start", "covers", "overlap", "way"
NEEDS, RELEASED_AFTER, FIRST_TAG, TAG_AFTER = "needs", "released after", "first tag", "tag after"
ESCAPED = (("%", "%25"), ("\t", "%09"), ("\n", "%0A"))
"""What cannot stand in a name, and what stands for it; the first first."""


def written(layout: Layout, route: Route) -> TagList:
    """Write down all that a unit will use of a route (T4)."""
    first = layout.first_tag.get(route)
    return TagList(
        "\n".join(
            (
                line(START, [layout.start[route]]),
                line(COVERS, sorted(layout.covers[route])),
                line(OVERLAP, sorted(layout.overlap[route])),
                *(line(WAY, chain) for chain in chains(layout.way[route])),
                *(line(NEEDS, pair) for pair in sorted(layout.needs[route].items())),
                *(line(RELEASED_AFTER, pair) for pair in sorted(layout.released_after[route].items())),
                *(() if first is None else (line(FIRST_TAG, [first]),)),
                *(line(TAG_AFTER, chain) for chain in chains(layout.tag_after.get(route, {}))),
            )
        )
    )


def with_tag_lists(layout: Layout) -> Layout:
    """The same layout, with a list for each of its routes (T4)."""
    return replace(layout, tag_list={route: written(layout, route) for route in layout.routes})


def what_they_say(tag_lists: Iterable[TagList]) -> TagLists:
    """Read lists: all that a unit knows of the routes that it was sent (T4)."""
    said = {tag_list: tuple(lines(tag_list)) for tag_list in tag_lists}
    start = {text: Block(found[0]) for text, read in said.items() if (found := named(read, START))}
    covers = {text: frozenset(map(Block, named(read, COVERS))) for text, read in said.items()}
    overlap = {text: frozenset(map(Block, named(read, OVERLAP))) for text, read in said.items()}
    return TagLists(
        start=start,
        covers=covers,
        overlap=overlap,
        claims={text: covers[text] | overlap[text] | ({start[text]} if text in start else set()) for text in said},
        way={text: {Block(a): Block(b) for a, b in pairs(read, WAY)} for text, read in said.items()},
        needs={text: {Point(a): Position(b) for a, b in pairs(read, NEEDS)} for text, read in said.items()},
        released_after={
            text: {Block(a): Block(b) for a, b in pairs(read, RELEASED_AFTER)} for text, read in said.items()
        },
        first_tag={text: Tag(found[0]) for text, read in said.items() if (found := named(read, FIRST_TAG))},
        tag_after={text: {Tag(a): Tag(b) for a, b in pairs(read, TAG_AFTER)} for text, read in said.items()},
    )


def line(what: str, names: Sequence[str]) -> str:
    """Write one line."""
    return "\t".join((what, *map(escaped, names)))


def escaped(name: str) -> str:
    """Write a name without what ends one."""
    for plain, written_so in ESCAPED:
        name = name.replace(plain, written_so)
    return name


def unescaped(text: str) -> str:
    """Read a name."""
    for plain, written_so in reversed(ESCAPED):
        text = text.replace(written_so, plain)
    return text


def lines(tag_list: TagList) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Read the lines of a list: what is said, and of which names."""
    for each in tag_list.split("\n"):
        what, *names = each.split("\t")
        yield what, tuple(map(unescaped, names))


def named(read: Iterable[tuple[str, tuple[str, ...]]], what: str) -> tuple[str, ...]:
    """Give the names that the lines of one kind name."""
    return tuple(name for said, names in read if said == what for name in names)


def pairs(read: Iterable[tuple[str, tuple[str, ...]]], what: str) -> Iterator[tuple[str, str]]:
    """Give each two names that follow each other in a line of one kind."""
    for said, names in read:
        if said == what:
            yield from pairwise(names)


def chains(after: Mapping[Name, Name]) -> Iterator[list[Name]]:
    """Give a relation as the fewest rows of names, in each of which every one is followed by its own next."""
    left = dict(after)
    while left:
        follow = set(left.values())
        chain = [min((name for name in left if name not in follow), default=min(left))]
        while chain[-1] in left:
            chain.append(left.pop(chain[-1]))
        yield chain
