"""Reads the bytes of a record strictly, so that no two readers can take one file for two different records."""

from __future__ import annotations

import json
import math
import os
import stat
from pathlib import Path
from typing import Any, NoReturn

from lxml import etree

KINDS = {
    stat.S_IFLNK: "a symbolic link",
    stat.S_IFIFO: "a FIFO",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFSOCK: "a socket",
    stat.S_IFDIR: "a folder",
}


class NotStrict(ValueError):
    """What stands in a file can be read in more than one way, or in none."""


def is_other(path: Path) -> str:
    """What a path is, in words, where it is anything but a regular file; empty for one, and for what is not there."""
    try:
        mode = path.lstat().st_mode
    except OSError:
        return ""
    return "" if stat.S_ISREG(mode) else KINDS.get(stat.S_IFMT(mode), "no file")


def content_of(path: Path) -> bytes:
    """The bytes of a regular file; nothing else is opened for reading, and nothing is waited for.

    Raises:
        NotStrict: it is a link, a FIFO, a device or a folder.
        OSError: it is not there, or cannot be read.
    """
    other = is_other(path)
    if other:
        raise NotStrict(f"is {other}, and no regular file")
    with os.fdopen(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
        return file.read()


def parsed(content: bytes | str) -> Any:
    """JSON in UTF-8, each key once in an object, each number finite, not nested without end.

    Raises:
        NotStrict: it is anything else.
    """
    try:
        text = content if isinstance(content, str) else content.decode("utf-8")
        return json.loads(text, object_pairs_hook=_once, parse_constant=_no_number, parse_float=_finite)
    except UnicodeDecodeError as error:
        raise NotStrict(f"is not UTF-8: {error.reason}") from error
    except RecursionError as error:
        raise NotStrict("is nested too deep") from error


def tree(content: bytes) -> etree._Element:
    """The root of an XML document in UTF-8 that declares no type and no entity.

    Raises:
        NotStrict: it declares some, or is in another encoding.
        etree.XMLSyntaxError: it is no XML.
    """
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise NotStrict(f"is not UTF-8: {error.reason}") from error
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, dtd_validation=False)
    root = etree.fromstring(content, parser)
    about = root.getroottree().docinfo
    if about.internalDTD is not None or "<!ENTITY" in text:
        raise NotStrict("declares a document type, which could say anything")
    if (about.encoding or "UTF-8").upper() not in ("UTF-8", "ASCII", "US-ASCII"):
        raise NotStrict(f"is in {about.encoding}, not in UTF-8")
    return root


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise NotStrict(f"the key {twice!r} stands twice in one object")
    return found


def _no_number(constant: str) -> NoReturn:
    raise NotStrict(f"{constant} is no number")


def _finite(text: str) -> float:
    found = float(text)
    if not math.isfinite(found):
        raise NotStrict(f"{text} is no finite number")
    return found
