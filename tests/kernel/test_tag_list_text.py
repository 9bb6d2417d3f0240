"""A tag list says of a route what its layout does, whatever blocks, points and tags are called (T4)."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.layout import Layout
from kernel.names import Block, Route, Tag, TagList
from kernel.tag_list import TagLists
from kernel.tag_list_text import ESCAPED, escaped, line, unescaped, what_they_say, with_tag_lists, written
from models.layouts.loading import load
from tests.world.small_site import small_site

SAMPLES = sorted((Path(__file__).parents[2] / "layouts").glob("*.toml"))
NAMES = st.text(min_size=1, max_size=6) | st.sampled_from(["%09", "\t", "\n", "%", "a\tb", "%25", "west"])
RELATIONS = st.dictionaries(NAMES, NAMES, max_size=8)
SMALL = small_site().layout
ROUTE = min(SMALL.routes)


def says_as_much(layout: Layout, route: Route) -> bool:
    """Whether the list of a route, read, is what the layout has of it, field by field."""
    text = written(layout, route)
    said = what_they_say([text])
    return all(getattr(said, field.name).get(text) == getattr(layout, field.name).get(route) for field in fields(said))


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_a_list_says_what_the_layout_does(path: Path) -> None:
    layout = load(path).layout
    assert layout.routes
    assert all(says_as_much(layout, route) for route in layout.routes)
    assert layout.tag_list == {route: written(layout, route) for route in layout.routes}
    assert len(set(layout.tag_list.values())) == len(layout.routes)


@given(NAMES, st.sets(NAMES), st.sets(NAMES), RELATIONS, RELATIONS, RELATIONS, RELATIONS, st.none() | NAMES)
def test_whatever_names_are_in_a_list_are_read_again(
    start: str,
    covers: set[str],
    overlap: set[str],
    way: dict[str, str],
    needs: dict[str, str],
    after: dict[str, str],
    tags: dict[str, str],
    first: str | None,
) -> None:
    told: dict[str, Any] = {"start": start, "covers": frozenset(covers), "overlap": frozenset(overlap), "way": way}
    told |= {"needs": needs, "released_after": after, "tag_after": tags, "claims": {start} | covers | overlap}
    fields_told: dict[str, Any] = {name: {ROUTE: value} for name, value in told.items()}
    layout = replace(SMALL, **fields_told | {"first_tag": {}})
    if first is not None:
        layout = replace(layout, first_tag={ROUTE: Tag(first)})
    assert says_as_much(layout, ROUTE)


@given(NAMES, NAMES)
def test_no_two_names_are_written_alike(one: str, other: str) -> None:
    assert unescaped(escaped(one)) == one
    assert (escaped(one) == escaped(other)) == (one == other)
    assert not any(mark in escaped(one) for mark, _ in ESCAPED[1:])


@given(st.text())
def test_any_text_says_something(text: str) -> None:
    """What is no list is read all the same, and says less; nothing is raised."""
    said = what_they_say([TagList(text)])
    assert said.claims[TagList(text)] >= said.covers[TagList(text)]


def test_what_is_not_said_is_not_there() -> None:
    said = what_they_say([TagList("covers\ta\nhearsay\tb")])
    assert not said.start
    assert not said.first_tag
    assert list(said.covers.values()) == list(said.claims.values()) == [{Block("a")}]
    assert what_they_say([]) == TagLists({}, {}, {}, {}, {}, {}, {}, {}, {})


def test_a_list_is_lines_of_names() -> None:
    """As it is told in the module's docstring."""
    text = written(SMALL, ROUTE)
    assert text.split("\n")[0] == line("start", [SMALL.start[ROUTE]])
    assert with_tag_lists(SMALL).tag_list[ROUTE] == text
