-- A campaign's store.  A batch counts once: its row's key forbids a second one, and everything that is
-- added for it is added in the transaction that inserts the row.

CREATE TABLE identity (thing TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;

-- Each start of the campaign: when, with which seed, commit and versions.
CREATE TABLE starts (at TEXT NOT NULL, seed INTEGER NOT NULL, record TEXT NOT NULL) STRICT;

-- status: done, hung (longer than it may), died (its process ended), failed (an exception).
-- covered, pairs: [id, hits, id, hits ...] as 64-bit words, deflated; sketch: deflated.
-- digest: of everything that follows from the batch, so not of the seconds.
CREATE TABLE batches (
    seed INTEGER NOT NULL, target TEXT NOT NULL, number INTEGER NOT NULL,
    status TEXT NOT NULL, weights TEXT NOT NULL,
    traces INTEGER NOT NULL, steps INTEGER NOT NULL, seconds REAL NOT NULL,
    counts TEXT NOT NULL, covered BLOB NOT NULL, pairs BLOB NOT NULL, sketch BLOB NOT NULL,
    digest TEXT NOT NULL, words TEXT NOT NULL,
    PRIMARY KEY (seed, target, number)
) STRICT;

-- The weights that a round began with, one JSON list of numbers.
CREATE TABLE rounds (
    seed INTEGER NOT NULL, target TEXT NOT NULL, round INTEGER NOT NULL, weights TEXT NOT NULL,
    PRIMARY KEY (seed, target, round)
) STRICT;

-- Sums over all batches; first: the lowest number of a batch that hit it.
CREATE TABLE counts (target TEXT, name TEXT, value INTEGER NOT NULL, PRIMARY KEY (target, name)) STRICT;
CREATE TABLE covered (
    target TEXT, id INTEGER, hits INTEGER NOT NULL, first INTEGER NOT NULL, PRIMARY KEY (target, id)
) STRICT, WITHOUT ROWID;
CREATE TABLE pairs (
    target TEXT, id INTEGER, hits INTEGER NOT NULL, first INTEGER NOT NULL, PRIMARY KEY (target, id)
) STRICT, WITHOUT ROWID;
CREATE TABLE sketches (target TEXT PRIMARY KEY, registers BLOB NOT NULL) STRICT;

-- One row for each cause in a batch; trace: the first of so many.
CREATE TABLE failures (
    seed INTEGER NOT NULL, target TEXT NOT NULL, number INTEGER NOT NULL, digest TEXT NOT NULL,
    invariant TEXT NOT NULL, times INTEGER NOT NULL, trace TEXT NOT NULL,
    PRIMARY KEY (seed, target, number, digest)
) STRICT;

-- Planted faults that the campaign's targets had to find; target: which did, empty for none.
CREATE TABLE canaries (
    seed INTEGER NOT NULL, kind TEXT NOT NULL, fault TEXT NOT NULL, target TEXT NOT NULL,
    batches INTEGER NOT NULL, seconds REAL NOT NULL,
    PRIMARY KEY (seed, kind)
) STRICT;
