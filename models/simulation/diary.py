"""What happened, as a list of events; the steps of the world in the words of the line, and what staff does."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from models.world.state import System

FAULT, BRAKE, ROUTE, TRAIN, STAFF, RADIO, ROAD = "fault", "brake", "route", "train", "staff", "radio", "road"


@dataclass(frozen=True)
class Event:
    """Something that happened, ``at_ms``, to or by ``who``: a train, a point, a road or the centre."""

    at_ms: int
    kind: str
    who: str
    text: str


class Diary:
    """Events in their order, and how often each step of the world was taken; ``last_fault``: the newest, by name."""

    def __init__(self) -> None:
        self.now_ms = 0
        self.events: list[Event] = []
        self.steps: Counter[str] = Counter()
        self.faults: Counter[str] = Counter()
        self.last_fault = ""

    def note(self, kind: str, who: str, text: str) -> None:
        """Write something down."""
        self.events.append(Event(self.now_ms, kind, who, text))

    def fault(self, name: str, who: str, text: str) -> None:
        """Write a fault down, and count it."""
        self.faults[name] += 1
        self.last_fault = name
        self.note(FAULT, who, text)

    def after(self, step: str, event: Mapping[str, Any], system: System) -> None:
        """Write down a step of the world, if it is one to tell."""
        self.steps[step] += 1
        run = event.get("run")
        if step == "request":
            self.note(ROUTE, event["run"].train, f"is granted {event['run'].route}; points are laid")
        elif step == "take_permit":
            self.note(ROUTE, event["run"].train, f"may enter {event['run'].route}")
        elif step == "withdraw":
            self.note(ROUTE, event["run"].train, f"loses {event['run'].route}, which it was not told of yet")
        elif step == "note_given_back":
            self.note(ROUTE, event["run"].train, f"has given {event['run'].route} back")
        elif step == "window_passes":
            self.note(BRAKE, event["train"], "finds the next tag overdue and brakes")
        elif step == "head_reads" and not event["in_window"]:
            self.note(BRAKE, event["train"], f"reads {event['tag']}, not the tag that is due, and brakes")
        elif step == "note_standing" and run is not None:
            blocks = ", ".join(sorted(block for block, runs in system.centre.claimed.items() if run in runs))
            self.note(STAFF, run.train, f"has told where it stands: {blocks}")
        elif step == "note_statement_confirmed" and run is not None:
            self.note(STAFF, run.train, "is stated by two persons where it stands (supervised release)")
