"""Pages that are written from the sources: ``python -m proofs.pages`` writes all of them anew."""

from __future__ import annotations

import ast
import inspect
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from pathlib import Path

from kernel import persistence
from kernel.alarm.distance import TrainFix
from kernel.alarm.tone import Handset
from kernel.alarm.train_list import Server
from kernel.centre import Centre
from kernel.crossing.arrival import Followed
from kernel.crossing.crossing import Crossing
from kernel.crossing.promise import Promise
from kernel.crossing.ranging_schedule import Schedule
from kernel.crossing.start_point import StartPoint
from kernel.link import Link
from kernel.onboard.antenna_spacing import Spacing
from kernel.onboard.brake_watch import BrakeWatch
from kernel.onboard.split import Split
from kernel.onboard.tag_reader import Reader
from kernel.persistence import Memory
from kernel.terminal import Terminal
from kernel.tram import centre as tram_centre
from kernel.tram import display as tram_display
from kernel.tram.cycle import Heard
from kernel.tram.stopping import Stopping
from kernel.unit import Unit
from models.world import at_a_point, at_the_centre, nature, on_board, radio
from proofs import assumptions, fault_pages, joints, promise, promises
from proofs.catalogue import STEPS
from proofs.lints import requirements_in
from proofs.lints_on_board import OTHERS, world
from proofs.lints_on_board import asking as asking_on_board
from proofs.lints_on_board import assumptions as asked_on_board
from proofs.theories import THEORIES, row_of
from proofs.transitions import event_types
from proofs.usage import claims

ROOT = assumptions.ROOT
DOCS = ROOT / "docs"
WHY = ROOT / "models" / "world" / "transitions.toml"
PLACES = (at_the_centre, on_board, at_a_point, radio, nature)
"""The modules of the world's transitions, in the order of the page."""

WRITTEN = "Written by `python -m proofs.pages` from"


# ---- what survives which restart


def described(state: type) -> Mapping[str, str]:
    """Give what a state's docstring says of each field; names that share a sentence share it here."""
    text = " ".join((state.__doc__ or "").split())
    found: dict[str, str] = {}
    for names, words in re.findall(r"((?:``\w+``(?:, )?)+): (.*?)(?=\s``\w+``(?:, ``\w+``)*: |$)", text):
        for name in re.findall(r"\w+", names):
            found[name] = words
    return found


TRAM_CENTRE = (
    "Nothing survives, and no life is counted: times of GPS do that. What was told or confirmed before a start is older"
    " than `opens_ms` and counts for nothing, so a report that is repeated or late changes nothing either; nor does it"
    " matter whether a spare centre has taken over. Trams on the way get no orders until they come again; nobody"
    " recovers before a tram that came at the first stop since has left the stop after next."
)
CROSSING = (
    "Every train is forgotten, with its ceiling by the ground unit as well. The road is closed, arms down, until a"
    " person has seen each track empty. No life is counted: a train that waits at a starting signal asks anew, and one"
    " that was let go is under way, so that its track is not empty; a message that comes twice changes nothing. The"
    " number goes on, so that no word of a person from before the start counts; a spare goes on from a number that is"
    " higher, once the other is cut off, or such a word would open the road."
)
TRAIN_IN_CONTACT = (
    "Nothing survives: of no train is a ranging known, and whoever is in contact may be at the road, at the line's"
    " greatest speed, until one that counts says otherwise. Until each track was seen empty the crossing warns anyway"
    " (above). A spare ground unit starts in the same way, and an old ranging that is delivered once more counts by its"
    " age alone."
)
PROMISE = (
    "All of it survives a restart of the train: it is written before it is told. The crossing forgets what it has"
    " noted, and holds the train to the line's speed until it is told anew. A spare unit that holds none is not let go"
    " before a person has told the crossing."
)
TAG_READER = (
    "Nothing survives, of the head's reader nor of the tail's. Whether an antenna had failed is forgotten, so each"
    " counts as failed, and delivers nothing, until staff has found it sound (`kernel.onboard.computer.mend_head`,"
    " `mend_tail`). Finding the train whole does not say so, nor does locating it anew: after that, as ends may have"
    " been changed, one antenna that has failed makes both count as failed."
)
SPLIT = (
    "Nothing survives: whether the train had split is forgotten, so it counts as split and is braked, until staff has"
    " found it whole (`kernel.onboard.computer.made_up`), which counts once the brake is known to hold the train. So it"
    " is of a spare unit."
)
BRAKE_WATCH = (
    "Nothing survives: whether motors or brake had broken a bound is forgotten, so they count as if they had, and the"
    " train is braked, until staff has inspected them and tried the brake (`kernel.onboard.computer.inspect_brake`),"
    " which counts once the brake is known to hold the train."
)
SPACING = (
    "Nothing survives: how far the antennas are apart, and whether the tail was a false one, is forgotten, so no read"
    " of the tail counts until staff has found the train whole, which presets the written distance."
)
LINK = (
    "Its names are written, and its life is counted up before the first telegram; all else is forgotten. Nothing that"
    " was sent to an earlier life is delivered, and of the peer's lives nothing of one that is over. A life that is"
    " repeated, as by a spare unit with a count of its own, would let telegrams from before the start be delivered once"
    " more. That is assumed away (`counters_survive`), and is a duty of whoever swaps a unit: its count goes on above"
    " that of the other one."
)
RANGING_SCHEDULE = (
    "The number survives: it is written before the order is sent, so that no answer to an order from before the start"
    " counts. All contact is made anew. What was ordered may still be under way, so the channel is taken for a slot. A"
    " spare unit goes on from a number that is no lower, once the other is cut off from the radios; a train or a"
    " crossing that restarts changes nothing of it."
)
START_POINT = (
    "Nothing survives: no read waits for its strike, and none that comes late counts before it is too old to be told."
    " Who struck while it was without power was not noted, so it tells that strikes may have been missed, each time"
    " that it is heard, until the crossing has acknowledged that: its track warns until a person has seen it empty."
    " Until it is heard its silence warns. A spare unit starts in the same way. The terminal of an end point keeps"
    " nothing at all: each telegram of a tail is judged by itself, and one from before a start counts for no longer"
    " than any other."
)
TRAM_ANSWER = (
    "Nothing survives but the slot, which is written: no tram is known before it has answered in that. A spare station"
    " starts in the same way."
)
TRAM_STOPPING = (
    "Nothing survives. A unit that starts anew, or is swapped for a spare one, begins with the first stop of the way,"
    " and by its fixes comes to one after the other; at the beginning of a run it is the stop where that begins. So it"
    " tells of no stop that the tram has not come to, nor that it stands before a fix has shown that; what is behind"
    " the place where the centre knows it is not taken."
)
TRAM_DISPLAY = (
    "Nothing survives: orders from before the start are older than `made_ms` and are not taken, once or again; nor are"
    " those to a unit that has been swapped for a spare one, which starts in the same way."
)
ALARM_UNIT = (
    "Nothing survives. The receiver may have hung before the start, and nobody knows since when it has told its place:"
    " the first place after a start is no fix until another is told, to the millimetre."
)
ALARM_SERVER = (
    "Nothing survives. Its life is GPS time at the start, so no counter on a disk can be lost; a life that is repeated"
    " would look like the one before, and is assumed away. The list is not whole until a person has confirmed it for"
    " this life: a confirmation for an earlier one is none, and an entry or a list from before the start is of another"
    " life. So it is of a spare server that takes over."
)
ALARM_HANDSET = (
    "Nothing survives: no tone is mild before it has read a whole list from its first entry on, and has a fix of its"
    " own. So it is of a spare handset."
)


def persistence_page() -> str:
    """Give the page on the persistence table."""
    lines = [
        "# What survives which restart",
        "",
        f"{WRITTEN} `kernel/persistence.py`; do not edit.",
        "",
        (
            "The restart functions of `kernel/restarts.py` are written from the same table by"
            " `python -m proofs.restarts`, and the proof runs over them (T8)."
        ),
    ]
    for title, state, table, about in (
        ("The centre", Centre, persistence.CENTRE, "Nothing but two counters survives; every block and point is lost."),
        ("The on-board unit", Unit, persistence.UNIT, "Without orders it has no authority, so it stands."),
        ("The point terminal", Terminal, persistence.TERMINAL, "The lock is mechanical; the lock id is lost."),
        ("The level crossing", Crossing, persistence.CROSSING, CROSSING),
        ("What a crossing has of a train in contact", Followed, persistence.TRAIN_IN_CONTACT, TRAIN_IN_CONTACT),
        ("A train's promise to a crossing", Promise, persistence.PROMISE, PROMISE),
        ("A tag reader on board", Reader, persistence.TAG_READER, TAG_READER),
        ("Split detection on board", Split, persistence.SPLIT, SPLIT),
        ("The brake watch on board", BrakeWatch, persistence.BRAKE_WATCH, BRAKE_WATCH),
        ("The spacing of a train's antennas", Spacing, persistence.SPACING, SPACING),
        ("One end of a radio link", Link, persistence.LINK, LINK),
        ("The slots of a radio channel", Schedule, persistence.RANGING_SCHEDULE, RANGING_SCHEDULE),
        ("The terminal of a start point", StartPoint, persistence.START_POINT, START_POINT),
        ("The trams' centre", tram_centre.Centre, persistence.TRAM_CENTRE, TRAM_CENTRE),
        ("What a tram station has heard", Heard, persistence.TRAM_ANSWER, TRAM_ANSWER),
        ("Where a tram stands, by its unit", Stopping, persistence.TRAM_STOPPING, TRAM_STOPPING),
        ("The display on a tram", tram_display.Display, persistence.TRAM_DISPLAY, TRAM_DISPLAY),
        ("The unit that sends a train's place to the alarm", TrainFix, persistence.ALARM_UNIT, ALARM_UNIT),
        ("The display's server, which keeps the alarm's list", Server, persistence.ALARM_SERVER, ALARM_SERVER),
        ("A track worker's handset", Handset, persistence.ALARM_HANDSET, ALARM_HANDSET),
    ):
        said = described(state)
        lines += ["", f"## {title}", "", about, "", "| variable | what it is | at a restart |", "|---|---|---|"]
        for field in fields(state):
            memory, value = table[field.name]
            kept = memory.value if memory is not Memory.LOST else f"{memory.value}: `{value}`"
            lines.append(f"| `{field.name}` | {plain(said.get(field.name, ''))} | {kept} |")
    return "\n".join([*lines, ""])


def plain(text: str) -> str:
    """Give a docstring as Markdown."""
    return text.replace("``", "`").replace("|", "\\|")


# ---- what the world does


def world_page() -> str:
    """Give the page on the world's transitions."""
    why: Mapping[str, Mapping[str, str]] = tomllib.loads(WHY.read_text("utf-8"))
    lines = [
        "# The world of the proof",
        "",
        f"{WRITTEN} the docstrings of `models/` and `models/world/transitions.toml`; do not edit.",
        "",
        (
            "The proof is about a system that does nothing but these steps, in any order, any number of times, with any"
            " values. So each must be said to be all that can happen there. A named assumption, in"
            " [assumptions](assumptions.md), stands behind each thing that nature is trusted not to do."
        ),
    ]
    for place in PLACES:
        name = place.__name__.rsplit(".", 1)[-1]
        steps = {step: function for step, function in STEPS.items() if function.__module__ == place.__name__}
        lines += ["", f"## {name}", "", plain(inspect.getdoc(place) or ""), "", why[name]["about"]]
        for step, function in steps.items():
            event = ", ".join(event_types(function))
            lines += [
                "",
                f"### {step}({event})",
                "",
                " ".join(plain(inspect.getdoc(function) or "").split()),
                "",
                f"*Why no more:* {why[name][step]}",
            ]
            asked = [one for one in assumptions.predicates()["world"] if step in assumptions.asking(one)]
            if asked:
                lines += ["", "Assumed: " + ", ".join(f"`{one}`" for one in asked) + "."]
    for name, theory in OTHERS.items():
        said = [plain(inspect.getdoc(module) or "") for module in world(theory)]
        lines += ["", f"## {name}", "", "\n\n".join(said)]
        for step, function in theory.steps.items():
            event = ", ".join(event_types(function))
            lines += ["", f"### {name}.{step}({event})", "", " ".join(plain(inspect.getdoc(function) or "").split())]
            asked = [one for one in asked_on_board(theory) if step in asking_on_board(theory, one)]
            if asked:
                lines += ["", "Assumed: " + ", ".join(f"`{one}`" for one in asked) + "."]
    return "\n".join([*lines, ""])


# ---- from requirement to proof


def functions_of(folder: str) -> Mapping[str, Iterable[str]]:
    """Give the requirements that each public function of a folder and those in it names, by ``file.function``."""
    found = {}
    for path in sorted((ROOT / folder).rglob("*.py")):
        file = ".".join(path.relative_to(ROOT / folder).with_suffix("").parts)
        for node in ast.parse(path.read_text("utf-8")).body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                found[f"{file}.{node.name}"] = requirements_in(ast.get_docstring(node))
    return found


def trace() -> Mapping[str, Mapping[str, list[str]]]:
    """Give, for each requirement that is named at all, what names it: kernel, world, invariants."""
    sources: Mapping[str, Mapping[str, Iterable[str]]] = {
        "kernel functions": functions_of("kernel"),
        "transitions": {
            row_of(theory, step): requirements_in(inspect.getdoc(function))
            for theory in THEORIES.values()
            for step, function in theory.steps.items()
        },
        "invariants": {
            row_of(theory, name): requirements_in(inspect.getdoc(claim))
            for theory in THEORIES.values()
            for name, claim in claims(theory).items()
        },
    }
    labels = {label for each in sources.values() for named in each.values() for label in named}
    return {
        label: {kind: [name for name, named in each.items() if label in named] for kind, each in sources.items()}
        for label in sorted(labels, key=lambda label: (label[0] != "T", label[0], int(label[1:])))
    }


# ---- what comes about at last


def promises_page() -> str:
    """Give the page on promises."""
    lines = [
        "# What comes about at last",
        "",
        f"{WRITTEN} `proofs/promises/`; do not edit the tables.",
        "",
        plain(inspect.getdoc(promise) or "").split("\n\n", 1)[1].replace("\n", " "),
        "",
        (
            "`heisoku prove` proves it in the columns named after the goals: over every transition of the world, for"
            " every layout, or every train, from every state in which the invariants hold. There is no clock in it:"
            " fairness says *at last*, and how long that takes is measured (`heisoku simulate`)."
        ),
    ]
    for theory in THEORIES.values():
        for name, each in theory.promises.items():
            lines += ["", f"## {row_of(theory, name)}", "", sentences(each.goal), *_promised(each)]
    return "\n".join([*lines, "", plain(inspect.getdoc(promises) or "").split("\n\n", 1)[1], ""])


def _promised(each: promise.Promise) -> list[str]:
    """Give the lines on one promise, after its goal."""
    lines = [] if each.unless is None else ["", f"What may come in between: {sentences(each.unless)}"]
    lines += ["", "| while | this leads on | provided |", "|---|---|---|"]
    for link in each.links:
        event = ", ".join(event_types(link.by))
        if_so = sentences(link.provided) if link.provided else ""
        holds = sentences(link.holds)
        if link.rank is not None:
            holds += f" *The number that gets smaller:* {sentences(link.rank)}"
        lines.append(f"| {holds} | `{link.by.__name__}({event})` | {if_so} |")
    return lines


def sentences(function: Callable[..., object]) -> str:
    """Give a docstring on one line, as Markdown."""
    return " ".join(plain(inspect.getdoc(function) or "").split())


# ---- from requirements to code


def traceability_page() -> str:
    """Give the page that leads from requirements to code and proof."""
    lines = [
        "# From requirement to kernel and proof",
        "",
        f"{WRITTEN} the requirement labels in docstrings; do not edit.",
        "",
        (
            "[Requirements](requirements.md) says what each label means, and `heisoku prove --only NAME` proves the row"
            " or column of that name; before the dot stands the theory, `heisoku prove --only '^THEORY\\.NAME '`."
        ),
    ]
    for label, named in trace().items():
        lines += ["", f"## {label}", ""]
        lines += [f"- {kind}: {', '.join(f'`{name}`' for name in names)}" for kind, names in named.items() if names]
    return "\n".join([*lines, ""])


PAGES: Mapping[Path, Callable[[], str]] = {
    assumptions.PAGE: assumptions.page,
    joints.PAGE: joints.page,
    DOCS / "faults.md": fault_pages.page,
    DOCS / "liveness.md": promises_page,
    DOCS / "persistence.md": persistence_page,
    DOCS / "traceability.md": traceability_page,
    DOCS / "world.md": world_page,
}


def main() -> None:
    """Write every page in its place."""
    for path, page in PAGES.items():
        path.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
