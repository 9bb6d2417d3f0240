"""A railML document: its elements by id, and attributes that are there or are complained of."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from lxml import etree

from models.layouts.reading import identifier
from models.layouts.results import BadInput

VERSIONS_2 = ("2.0", "2.1", "2.2", "2.3", "2.4", "2.5")
VERSIONS_3 = ("3.1", "3.2", "3.3")
SHOWN = 40
"""So many characters of a value are repeated in a message."""
Element = etree._Element


@dataclass(frozen=True)
class Document:
    """The root of a document, and the name of its file for messages."""

    file: str
    root: Element

    @property
    def is_version_2(self) -> bool:
        """Whether track is told as in railML 2, by tracks and their connections."""
        return self.root.get("version") in VERSIONS_2

    def bad(self, element: Element | None, what: str, what_to_do: str) -> BadInput:
        """The error for an element, by its id if it has one."""
        if element is None:
            return BadInput(self.file, "railML", what, what_to_do)
        name = element.get("id")
        place = f"{kind_of(element)} '{name}'" if name else f"{kind_of(element)} in line {element.sourceline}"
        return BadInput(self.file, place, what, what_to_do)

    @cached_property
    def namespace(self) -> str | None:
        """The document's namespace, which is its root's; what stands in another one is no railML."""
        return etree.QName(self.root).namespace

    def is_own(self, element: Element) -> bool:
        """Whether an element is of the document's namespace."""
        return etree.QName(element).namespace == self.namespace

    def all(self, kind: str, inside: Element | None = None) -> Iterator[Element]:
        """Every element of a kind and of the document's namespace, in the order of the document."""
        name = kind if self.namespace is None else f"{{{self.namespace}}}{kind}"
        yield from (self.root if inside is None else inside).iterfind(f".//{name}")

    def first(self, kind: str, inside: Element) -> Element | None:
        """The first element of a kind inside another."""
        return next(self.all(kind, inside), None)

    @cached_property
    def by_id(self) -> dict[str, Element]:
        """Every element that has an id; ids are unique in a document.

        Raises:
            BadInput: one stands twice.
        """
        found: dict[str, Element] = {}
        for element in self.root.iter("{*}*"):
            name = element.get("id")
            if name is None or not self.is_own(element):
                continue
            identifier(self.file, f"{kind_of(element)} in line {element.sourceline}", name)
            if name in found:
                what = f"this id is taken by a {kind_of(found[name])} in line {found[name].sourceline}"
                raise self.bad(element, what, "rename one of the two")
            found[name] = element
        return found

    def attribute(self, element: Element, name: str) -> str:
        """An attribute that must be there.

        Raises:
            BadInput: it is not.
        """
        value = element.get(name)
        if value is None:
            raise self.bad(element, f"has no attribute {name}", "add it")
        return value

    def number(self, element: Element, name: str, least: float, most: float) -> float:
        """A number that must be there, within its range.

        Raises:
            BadInput: it is not.
        """
        text = self.attribute(element, name)
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not least <= value <= most:
            raise self.bad(
                element, f"{name} is '{text[:SHOWN]}', not a number from {least:g} to {most:g}", "correct it"
            )
        return value

    def referred(self, element: Element, attribute: str = "ref") -> Element:
        """The element that another one refers to.

        Raises:
            BadInput: there is none of that id.
        """
        name = self.attribute(element, attribute)
        found = self.by_id.get(name)
        if found is None:
            what = f"{attribute} refers to '{name[:SHOWN]}', which is not there"
            raise self.bad(element, what, "correct the reference or add what it names")
        return found


def document(file: str, text: str) -> Document:
    """Parse a text; nothing outside of it is read, and no entity is expanded.

    Raises:
        BadInput: it is no XML, no railML, or not of a version that is read.
    """
    parser = etree.XMLParser(
        resolve_entities=False, load_dtd=False, no_network=True, remove_comments=True, remove_pis=True, encoding="utf-8"
    )
    try:
        root = etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        place = f"line {error.lineno}" if error.lineno else "file"
        raise BadInput(file, place, f"is not XML: {error.msg}", "check that the file is complete") from error
    entity = next(root.iter(etree.Entity), None)
    if entity is not None:
        what = f"uses the entity {str(entity.text)[:SHOWN]}, and entities are not expanded"
        raise BadInput(file, f"line {entity.sourceline or '?'}", what, "write out what it stands for")
    found = Document(file, root)
    if kind_of(root).lower() != "railml":
        raise BadInput(file, f"line {root.sourceline}", f"is XML, but {kind_of(root)} and no railML", "bring railML")
    version = found.attribute(root, "version")
    if version not in (*VERSIONS_2, *VERSIONS_3):
        what = f"is railML {version[:SHOWN]}, which is not read"
        raise found.bad(None, what, f"bring one of the versions {', '.join((*VERSIONS_2, *VERSIONS_3))}")
    return found


def kind_of(element: Element) -> str:
    """The name of an element without its namespace."""
    return str(etree.QName(element).localname)
