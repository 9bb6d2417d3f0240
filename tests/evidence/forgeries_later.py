"""Forgeries that were once not named before anything was made again."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from tests.evidence.forgeries import (
    CERTIFIED,
    CHECKED,
    MUTATED,
    PROOF,
    Forgery,
    Told,
    dropped,
    edited,
    first_cell,
    replaced,
    set_to,
)


def in_utf_16(folder: Path) -> None:
    (folder / CHECKED).write_text((folder / CHECKED).read_text("utf-8"), "utf-16")


def nested_without_end(folder: Path) -> None:
    (folder / "joints.json").write_text("[" * 200_000, "utf-8")


def a_fifo(folder: Path) -> None:
    (folder / CHECKED).unlink()
    os.mkfifo(folder / CHECKED)


def a_link_to(target: str) -> Callable[[Path], None]:
    """Put a link in the place of a record; to another name of itself, if ``target`` is one beside it."""

    def forge(folder: Path) -> None:
        if not target.startswith("/"):
            (folder / CHECKED).rename(folder.parent / target)
        else:
            (folder / CHECKED).unlink()
        (folder / CHECKED).symlink_to(Path(target) if target.startswith("/") else folder.parent / target)

    return forge


def no_obligations_but_a_number(folder: Path) -> None:
    (folder / "obligations").mkdir()
    edited(PROOF, set_to("obligations", value=7))(folder)


def nothing_asked(told: Told) -> None:
    told["obligations"], told["canaries"], told["verdict"] = [], [], "undecided"


def without_z3(told: Told) -> None:
    for key in ("obligations", "canaries"):
        dropped(key, lambda each: each["solver"] == "z3")(told)


def without_a_first_seed(told: Told) -> None:
    cell = first_cell(told)
    told["obligations"].remove(cell)
    assert (cell["solver"], cell["seed"]) == ("z3", 0)


def of_rides(rides: int) -> Callable[[Told], None]:
    def edit(told: Told) -> None:
        told["campaigns"][0]["rides"] = rides

    return edit


def of_as_many_as_asked(rides: int) -> Callable[[Told], None]:
    def edit(told: Told) -> None:
        told["command"] = f"heisoku ride --rides {rides} --json out/ride.json"
        told["campaigns"][0]["rides"] = rides

    return edit


def agrees_in_words(told: Told) -> None:
    row = next(each for each in told["rows"] if each["agrees"] is not None)
    row["agrees"] = "no"


def elsewhere(told: Told) -> None:
    told["platform"] = "win-arm64"
    told["solvers"]["cvc5"] = "4" * 64


def started_elsewhere(told: Told) -> None:
    told["starts"].insert(0, {**told["starts"][0], "platform": "win-arm64"})


def all_skipped(folder: Path) -> None:
    text = (folder / "test.xml").read_text("utf-8")
    first, *others = text.split("/><testcase ")
    text = "/><testcase ".join([first, "><skipped/></testcase><testcase ".join(others)])
    (folder / "test.xml").write_text(text.replace("/></testsuite>", "><skipped/></testcase></testsuite>"), "utf-8")


def a_traceback(folder: Path) -> None:
    with (folder / "crosshair.txt").open("a", encoding="utf-8") as file:
        file.write("Traceback (most recent call last):\n")


def an_error(folder: Path) -> None:
    with (folder / "crosshair.txt").open("a", encoding="utf-8") as file:
        file.write("kernel/point.py:12: error: ZeroDivisionError\n")


def another_first(told: Told) -> None:
    told["layouts"].insert(0, {**told["layouts"][0], "file": f"elsewhere/{told['layouts'][0]['file']}"})


def without_clearance(told: Told) -> None:
    for each in told["layouts"]:
        each["clearance_mm"] = 0


RIDE, TRAM, FUZZ = "ride.json", "days-tram.json", "fuzz.json"

READ = (
    Forgery(
        "a verdict twice, refuted first",
        replaced(PROOF, '{"verdict": "proved"', '{"verdict": "refuted", "verdict": "proved"'),
        "unreadable",
        PROOF,
    ),
    Forgery("seconds that are no number", replaced(PROOF, '"seconds": 0.01', '"seconds": NaN'), "unreadable", PROOF),
    Forgery("seconds without end", replaced(PROOF, '"seconds": 0.01', '"seconds": 1e999'), "unreadable", PROOF),
    Forgery("a record in UTF-16", in_utf_16, "unreadable", CHECKED),
    Forgery("brackets without end", nested_without_end, "unreadable", "joints.json"),
    Forgery("a pattern that is none", edited(MUTATED, set_to("only", value="(")), "unreadable", MUTATED),
    Forgery(
        "certificates by a pattern that is none", edited(CERTIFIED, set_to("only", value="[")), "unreadable", CERTIFIED
    ),
    Forgery(
        "a pattern that backtracks for ever", edited(MUTATED, set_to("only", value="(?:.|.)*!")), "unreadable", MUTATED
    ),
    Forgery("a FIFO for a record", a_fifo, "no file", CHECKED),
    Forgery("a device for a record", a_link_to("/dev/zero"), "no file", CHECKED),
    Forgery("a link for a record", a_link_to("elsewhere.json"), "no file", CHECKED),
    Forgery("a number for a list", no_obligations_but_a_number, "unreadable", PROOF),
    Forgery("versions that are a list", edited(CHECKED, set_to("versions", value=[1])), "unreadable", CHECKED),
)
"""In how a file is read."""

PROOFS = (
    Forgery("no obligation at all", edited(PROOF, nothing_asked), "missing obligation", PROOF),
    Forgery(
        "what Z3 leaves undecided left out, with all else of Z3", edited(PROOF, without_z3), "missing obligation", PROOF
    ),
    Forgery(
        "the first seed of Z3 left out of one obligation",
        edited(PROOF, without_a_first_seed),
        "missing obligation",
        PROOF,
    ),
    Forgery(
        "a seed that nobody waits for",
        edited(PROOF, set_to("obligations", 0, "seed", value=10**9)),
        "foreign obligation",
        PROOF,
    ),
    Forgery(
        "less than nothing spent",
        edited(PROOF, set_to("obligations", 0, "rlimit_spent", value=-1)),
        "other figures",
        PROOF,
    ),
    Forgery(
        "more spent than the budget",
        edited(PROOF, set_to("obligations", 0, "rlimit_spent", value=10**15)),
        "other figures",
        PROOF,
    ),
    Forgery(
        "less than no time", edited(PROOF, set_to("obligations", 0, "seconds", value=-1.0)), "other figures", PROOF
    ),
)
"""In records of proofs."""

SUMS = (
    Forgery("no ride at all", edited(RIDE, of_rides(0)), "other sums", RIDE),
    Forgery("more rides than anybody asked for", edited(RIDE, of_rides(10**9)), "other sums", RIDE),
    Forgery("more rides than cycles", edited(RIDE, of_as_many_as_asked(10**9)), "other sums", RIDE),
    Forgery("less than no cycle", edited(RIDE, set_to("campaigns", 0, "sums", "cycles", value=-5)), "other sums", RIDE),
    Forgery(
        "more without a cause than there are",
        edited(RIDE, set_to("campaigns", 0, "unexplained", value=3)),
        "other sums",
        RIDE,
    ),
    Forgery("a paper's row that agrees as a word", edited("000.json", agrees_in_words), "other row", "000.json"),
    Forgery(
        "an external checker that never ran",
        edited(CERTIFIED, set_to("external", value="ethos")),
        "other checker",
        CERTIFIED,
    ),
)
"""In what is summed up."""

DAYS = (
    Forgery("more days than anybody asked for", edited(TRAM, set_to("days", value=10**9)), "other sums", TRAM),
    Forgery("no day at all", edited(TRAM, set_to("days", value=0)), "other sums", TRAM),
    Forgery(
        "more days without a cause than there are", edited(TRAM, set_to("unexplained", value=1)), "other sums", TRAM
    ),
)
"""The same of days, which only a whole folder has."""

ABOUTS = (
    Forgery(
        "a record of another platform", edited(RIDE, set_to("platform", value="win-arm64")), "other platform", RIDE
    ),
    Forgery(
        "a record of another Python", edited(RIDE, set_to("versions", "python", value="2.7.18")), "other versions", RIDE
    ),
    Forgery("a record of other solvers on another platform", edited(RIDE, elsewhere), "other solvers", RIDE),
    Forgery("a start on another platform", edited(FUZZ, started_elsewhere), "other platform", FUZZ),
    Forgery("a time that is none", edited(RIDE, set_to("made_at", value="tomorrow")), "other time", RIDE),
    Forgery("a time of no zone", edited(RIDE, set_to("made_at", value="2026-01-01T00:00:00")), "other time", RIDE),
    Forgery("a time to come", edited(RIDE, set_to("made_at", value="2999-01-01T00:00:00+00:00")), "other time", RIDE),
)
"""In what records say of how they were made."""

CAMPAIGN = (
    Forgery(
        "one canary of six",
        edited(FUZZ, lambda told: told.update(canaries=told["canaries"][:1])),
        "missing canary",
        FUZZ,
    ),
    Forgery(
        "a failure that only a target tells",
        edited(FUZZ, set_to("targets", "link", "failures", value=2)),
        "other verdict",
        FUZZ,
    ),
    Forgery("a batch that hung", edited(FUZZ, set_to("targets", "link", "unfinished", value=1)), "other verdict", FUZZ),
    Forgery("a batch left out", edited(FUZZ, set_to("left_out", value=["link, batch 3: hung"])), "other verdict", FUZZ),
    Forgery("no target", edited(FUZZ, set_to("targets", value={})), "other verdict", FUZZ),
    Forgery(
        "a target that is none",
        edited(FUZZ, lambda told: told["targets"].update(moon=told["targets"]["link"])),
        "foreign target",
        FUZZ,
    ),
    Forgery("a seed that nobody started", edited(FUZZ, set_to("seeds", value=[])), "other sums", FUZZ),
)
"""In the record of a campaign."""

LISTS = (
    Forgery(
        "a document type",
        replaced("test.xml", "<testsuites>", '<!DOCTYPE x [<!ENTITY e "">]><testsuites>'),
        "unreadable",
        "test.xml",
    ),
    Forgery("all tests skipped but one", all_skipped, "skipped tests", "test.xml"),
    Forgery(
        "a proof that failed in another form of the record",
        replaced("prove.xml", "<testcase ", '<testcase status="run" '),
        "other cases",
        "prove.xml",
    ),
    Forgery(
        "not confirmed, in words that begin so",
        replaced("crosshair.txt", "Confirmed over all paths.", "Confirmed?? no"),
        "foreign contract",
        "crosshair.txt",
    ),
    Forgery("an error among the contracts", an_error, "foreign contract", "crosshair.txt"),
    Forgery("a fault of what asks", a_traceback, "foreign contract", "crosshair.txt"),
)
"""In lists of tests and contracts."""

LAYOUTS = (
    Forgery(
        "another file under the name of a sample, before it", edited(CHECKED, another_first), "foreign layout", CHECKED
    ),
    Forgery("no clearance asked of any layout", edited(CHECKED, without_clearance), "other check", CHECKED),
    Forgery(
        "a layout of another text",
        edited(CHECKED, set_to("layouts", 0, "sha256", value="0" * 64)),
        "other layout",
        CHECKED,
    ),
)
"""In what layouts come to."""

LATER = (*LISTS, *LAYOUTS, *READ, *PROOFS, *SUMS, *ABOUTS, *CAMPAIGN)
"""All of them."""
