"""The store's file: opening it, telling what is wrong with it, and one transaction after the other."""

from __future__ import annotations

import errno
import fcntl
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from fuzz.campaign.identity import FORMAT
from fuzz.campaign.problems import CampaignError
from models.exit_codes import BAD_INPUT, UNDECIDED

DATABASE, LOCK = "campaign.db", "lock"
APPLICATION = 0x6865_696B
"""SQLite's mark of whose file it is."""
SCHEMA = Path(__file__).with_name("schema.sql")
WAITS_S = 20.0
"""For another process that reads the store."""


@contextmanager
def said(path: Path) -> Iterator[None]:
    """Say in one line what is wrong with a store.

    Raises:
        CampaignError: SQLite or the file system said so.
    """
    try:
        yield
    except sqlite3.Error as error:
        raise complaint(path, error) from error
    except OSError as error:
        where = error.filename or path
        line = f"{where}: cannot be written ({error.strerror}); make room or give leave, then start again with the same"
        code = UNDECIDED if error.errno in NO_ROOM else BAD_INPUT
        raise CampaignError(f"{line} folder: what was finished is kept", code) from error


NO_ROOM = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO))
"""What the file system says where the folder is right, and nothing can be written to it."""


def complaint(path: Path, error: sqlite3.Error) -> CampaignError:
    """One line: what is wrong with the store, and what to do; a store that is none is bad input."""
    code = getattr(error, "sqlite_errorcode", 0) & 0xFF
    if code in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB):
        return CampaignError(damaged(path, str(error)))
    line = f"{path}: cannot be read or written ({error}); mend that and start again: what was finished is kept"
    if code == sqlite3.SQLITE_FULL:
        line = f"{path}: the disk is full; make room and start again with the same folder: what was finished is kept"
    elif code == sqlite3.SQLITE_BUSY:
        line = f"{path}: is held by another program; end it and start again"
    return CampaignError(line, UNDECIDED)


def damaged(path: Path, what: str) -> str:
    """One line on a store that is not as it was written."""
    return (
        f"{path}: is damaged ({what}); put a copy in its place, or move the folder away and begin again"
        " (what is in its folder traces can still be replayed)"
    )


def opened(path: Path, new: bool = True) -> sqlite3.Connection:
    """Open a store, or begin one if ``new`` allows it.  It is checked as a whole first.

    Raises:
        CampaignError: it is damaged, is none, or was written by another version.
    """
    with said(path):
        connection = sqlite3.connect(path, timeout=WAITS_S, isolation_level=None)
        try:
            if connection.execute("SELECT COUNT(*) FROM sqlite_master").fetchone()[0] == 0:
                if not new:
                    raise CampaignError(f"{path}: holds no campaign yet; name the folder of one")
                begin(connection)
            else:
                look_through(path, connection)
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
        except BaseException:
            connection.close()
            raise
    return connection


def begin(connection: sqlite3.Connection) -> None:
    """Lay out a new store, all of it or nothing."""
    connection.executescript(
        f"PRAGMA journal_mode = WAL; BEGIN IMMEDIATE; PRAGMA application_id = {APPLICATION};"
        f" {SCHEMA.read_text('utf-8')}"
        f" INSERT INTO identity VALUES ('format', '{FORMAT}'); COMMIT;"
    )


def look_through(path: Path, connection: sqlite3.Connection) -> None:
    """Check a store as a whole."""
    found = [str(row[0]) for row in connection.execute("PRAGMA integrity_check(1)")]
    if found != ["ok"]:
        raise CampaignError(damaged(path, found[0].splitlines()[-1]))
    if connection.execute("PRAGMA application_id").fetchone()[0] != APPLICATION:
        raise CampaignError(f"{path}: is a database, and not of a campaign; name another folder")
    made_by = connection.execute("SELECT value FROM identity WHERE thing = 'format'").fetchone()
    if made_by is None or made_by[0] != FORMAT:
        was = made_by[0] if made_by else "an unknown version"
        line = f"{path}: was made by {was}, and this is {FORMAT}; go on with that version, or name another folder"
        raise CampaignError(line)


def locked(folder: Path) -> IO[bytes]:
    """Hold a folder for this process alone, until the file given back is closed or the process ends, however it does.

    Raises:
        CampaignError: another process holds it.
    """
    path = folder / LOCK
    with said(path):
        held = path.open("wb")
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            held.close()
            line = f"{folder}: another campaign is running there; wait for its end, or name another folder"
            raise CampaignError(line) from error
    return held
