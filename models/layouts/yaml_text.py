"""YAML without its dangers: no anchors, no aliases, no tags, no key twice; every scalar is a text."""

from __future__ import annotations

from typing import Any

import yaml

from models.layouts.reading import DEEPEST_NESTING, HALF, too_deep
from models.layouts.results import BadInput

Loader: Any = getattr(yaml, "CLoader", yaml.Loader)


def parse_yaml(file: str, text: str) -> Any:
    """The first document of a YAML text as dicts, lists and texts.

    It is built from the flat stream of events, so neither aliases nor nesting can multiply the work.
    """
    try:
        return _Builder(file).build(text)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"line {mark.line + 1} column {mark.column + 1}" if mark else "file"
        what = f"is not YAML: {error.problem or error.context}"
        raise BadInput(file, place, what, "check that the file is complete") from error
    except yaml.YAMLError as error:
        raise BadInput(file, "file", f"is not YAML: {error}", "save it as UTF-8 text") from error
    except RecursionError as error:
        raise too_deep(file) from error


class _Builder:
    """Puts events together to data."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.open: list[tuple[Any, list[str]]] = []
        self.whole: Any = None

    def build(self, text: str) -> Any:
        """The data; what YAML allows and a layout does not need is refused."""
        documents = 0
        for event in yaml.parse(text, Loader=Loader):
            documents += isinstance(event, yaml.DocumentStartEvent)
            if documents > 1:
                raise self.bad(event, "is a second document", "keep one document in the file")
            if isinstance(event, yaml.AliasEvent) or getattr(event, "anchor", None) is not None:
                raise self.bad(event, "uses an anchor or alias", "write the entry out")
            if isinstance(event, yaml.ScalarEvent):
                if HALF.search(event.value):  # which the compiled parser refuses itself
                    raise self.bad(event, "holds half of a character", "take it out")
                self.put(event, event.value)
            elif isinstance(event, yaml.CollectionStartEvent):
                if len(self.open) >= DEEPEST_NESTING:
                    raise too_deep(self.file)
                self.open.append(({} if isinstance(event, yaml.MappingStartEvent) else [], []))
            elif isinstance(event, yaml.CollectionEndEvent):
                self.put(event, self.open.pop()[0])
        return self.whole

    def put(self, event: Any, value: Any) -> None:
        """Add a finished value to what encloses it."""
        if not self.open:
            self.whole = value
            return
        outer, key = self.open[-1]
        if isinstance(outer, list):
            outer.append(value)
        elif key:
            outer[key.pop()] = value
        elif not isinstance(value, str):
            raise self.bad(event, "has a key that is not a text", "write a plain key")
        elif value in outer:
            raise self.bad(event, f"has the key '{value}' twice", "keep one of the two")
        else:
            key.append(value)

    def bad(self, event: Any, what: str, what_to_do: str) -> BadInput:
        """The error at an event."""
        return BadInput(self.file, f"line {event.start_mark.line + 1}", what, what_to_do)
