"""Which variable survives which restart (T8, ours).

``kernel/restarts.py`` is written from this table; a test holds the two together.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum


class Memory(Enum):
    """What a restart does to a variable."""

    LASTING = "kept in lasting memory"
    COUNTED = "counted up in lasting memory"
    LOST = "set to the safe side"


CENTRE: Mapping[str, tuple[Memory, str]] = {
    "epoch": (Memory.COUNTED, "epoch"),
    "newest": (Memory.LASTING, ""),
    "accounted": (Memory.LOST, "{}"),
    "runs": (Memory.LOST, "{}"),
    "claimed": (Memory.LOST, "{}"),
    "locked": (Memory.LOST, "{}"),
    "lost_blocks": (Memory.LOST, "layout.blocks"),
    "lost_points": (Memory.LOST, "layout.points"),
    "terminal_life": (Memory.LOST, "{}"),
    "supervised": (Memory.LOST, "frozenset()"),
    "statements": (Memory.LOST, "{}"),
}
"""The centre: nothing but the two counters survives; every block and point is lost."""

UNIT: Mapping[str, tuple[Memory, str]] = {
    "life": (Memory.COUNTED, "life"),
    "answered": (Memory.LOST, "None"),
    "standing_in": (Memory.LOST, "frozenset()"),
    "isolated_in": (Memory.LOST, "None"),
    "orders": (Memory.LOST, "{}"),
    "loop_open": (Memory.LOST, "False"),
    "leading": (Memory.LOST, "None"),
    "head_tag": (Memory.LOST, "None"),
    "tail_read": (Memory.LOST, "None"),
    "occupied": (Memory.LOST, "frozenset()"),
}
"""The on-board unit: without orders it has no authority, so it stands."""

TERMINAL: Mapping[str, tuple[Memory, str]] = {
    "life": (Memory.COUNTED, "life"),
    "holds": (Memory.LOST, "None"),
    "wanted": (Memory.LOST, "None"),
    "unlocked": (Memory.LASTING, ""),
}
"""The point terminal: the lock is mechanical and stays as it is; the lock id is lost."""

CROSSING: Mapping[str, tuple[Memory, str]] = {
    "asks": (Memory.LOST, "{}"),
    "starts": (Memory.LOST, "{}"),
    "silent_cycles": (Memory.LOST, "{track: settings.silence_cycles + 1 for track in tracks}"),
    "unaccounted": (Memory.LOST, "{track: True for track in tracks}"),
    "numbers": (Memory.LOST, "{}"),
    "looks": (Memory.LOST, "{track: number for track in tracks}"),
    "number": (Memory.COUNTED, "number"),
    "warns": (Memory.LOST, "True"),
    "warned_cycles": (Memory.LOST, "settings.bell_cycles"),
}
"""The crossing: it warns, and its arms go down without waiting for the bell, until each track is accounted for."""

TRAIN_IN_CONTACT: Mapping[str, tuple[Memory, str]] = {
    "way_um": (Memory.LOST, "0"),
    "short_um": (Memory.LOST, "0"),
    "ceiling_um": (Memory.LOST, "bounds.line_um"),
    "age_cycles": (Memory.LOST, "bounds.silence_cycles + 1"),
    "told_way_mm": (Memory.LOST, "0"),
    "told_speed_mm_s": (Memory.LOST, "0"),
    "warns": (Memory.LOST, "False"),
}
"""What a crossing has of a train in contact: no ranging counts (`kernel.crossing.arrival.nothing_known`)."""

PROMISE: Mapping[str, tuple[Memory, str]] = {
    "number": (Memory.LASTING, ""),
    "ceiling_mm_s": (Memory.LASTING, ""),
    "asked_mm_s": (Memory.LASTING, ""),
}
"""A train's promise to a crossing: it is kept through restarts of the train (`kernel.crossing.promise`)."""

TAG_READER: Mapping[str, tuple[Memory, str]] = {
    "newest": (Memory.LOST, "NO_FRAME"),
    "second": (Memory.LOST, "NO_FRAME"),
    "third": (Memory.LOST, "NO_FRAME"),
    "held": (Memory.LOST, "NO_FRAME"),
    "fresh": (Memory.LOST, "False"),
    "quiet_frames": (Memory.LOST, "0"),
    "healthy": (Memory.LOST, "False"),
}
"""A tag reader: its antenna counts as failed (`kernel.onboard.tag_reader.restarted`)."""

SPLIT: Mapping[str, tuple[Memory, str]] = {
    "differences_mm_s2": (Memory.LOST, "EMPTY"),
    "in_a_row": (Memory.LOST, "0"),
    "missed_ms": (Memory.LOST, "limits.gap_ms + 1"),
    "doubtful": (Memory.LOST, "False"),
    "split": (Memory.LOST, "True"),
    "lost": (Memory.LOST, "False"),
}
"""Split detection: the train counts as split (`kernel.onboard.split.restarted`)."""

BRAKE_WATCH: Mapping[str, tuple[Memory, str]] = {
    "limit_mm_s": (Memory.LOST, "0"),
    "cycles": (Memory.LOST, "0"),
    "broken": (Memory.LOST, "True"),
}
"""The brake watch: motors or brake count as having broken a bound (`kernel.onboard.brake_watch.restarted`)."""

SPACING: Mapping[str, tuple[Memory, str]] = {
    "preset_mm": (Memory.LOST, "0"),
    "reads": (Memory.LOST, "HeadReads(*8 * [NOTHING_READ])"),
    "tail_read": (Memory.LOST, "False"),
    "tail_uid": (Memory.LOST, "0"),
    "checked": (Memory.LOST, "False"),
    "broken": (Memory.LOST, "True"),
}
"""The spacing of a train's antennas: its tail counts as a false one (`kernel.onboard.antenna_spacing.restarted`)."""

LINK: Mapping[str, tuple[Memory, str]] = {
    "me": (Memory.LASTING, ""),
    "peer": (Memory.LASTING, ""),
    "life": (Memory.COUNTED, "life"),
    "peer_life": (Memory.LOST, "None"),
    "sent": (Memory.LOST, "0"),
    "newest": (Memory.LOST, "None"),
    "missed": (Memory.LOST, "0"),
    "clock_ms": (Memory.LOST, "now_ms"),
}
"""One end of a link: a new life, in which nobody was heard (`kernel.link.begin`)."""

RANGING_SCHEDULE: Mapping[str, tuple[Memory, str]] = {
    "turns": (Memory.LOST, "{}"),
    "pairs": (Memory.LOST, "0"),
    "number": (Memory.COUNTED, "number"),
    "taken_ms": (Memory.LOST, "settings.slot_ms"),
}
"""The slots of a radio channel: all that is ordered may still be under way, and its number is not given again."""

START_POINT: Mapping[str, tuple[Memory, str]] = {
    "reader": (Memory.LOST, "nobody"),
    "left_cycles": (Memory.LOST, "0"),
    "struck_cycles": (Memory.LOST, "0"),
    "owes": (Memory.LOST, "True"),
}
"""The terminal of a start point: nothing survives, and it tells of a strike that it may have missed."""

TRAM_CENTRE: Mapping[str, tuple[Memory, str]] = {
    "now_ms": (Memory.LOST, "now_ms"),
    "opens_ms": (Memory.LOST, "now_ms + limits.coming_ms"),
    "cleared": (Memory.LOST, "NOTHING_CLEARED"),
    "trams": (Memory.LOST, "{}"),
    "left_ms": (Memory.LOST, "{}"),
    "shown": (Memory.LOST, "frozenset()"),
    "elsewhere_ms": (Memory.LOST, "{}"),
}
"""The trams' centre: nothing survives (`kernel.tram.centre.restarted`)."""

TRAM_ANSWER: Mapping[str, tuple[Memory, str]] = {
    "slot": (Memory.LASTING, ""),
    "is_known": (Memory.LOST, "False"),
    "age_ms": (Memory.LOST, "0"),
    "in_this_cycle": (Memory.LOST, "False"),
}
"""What a station has of a tram: nothing was heard (`kernel.tram.cycle.nothing_heard`)."""

TRAM_STOPPING: Mapping[str, tuple[Memory, str]] = {
    "stop": (Memory.LOST, "stop"),
    "left": (Memory.LOST, "False"),
    "stands": (Memory.LOST, "False"),
    "is_followed": (Memory.LOST, "False"),
    "least_mm": (Memory.LOST, "0"),
    "most_mm": (Memory.LOST, "0"),
    "has_run": (Memory.LOST, "False"),
}
"""Where a tram stands: at the first stop, or farther on (`kernel.tram.stopping.begun`)."""

TRAM_DISPLAY: Mapping[str, tuple[Memory, str]] = {
    "now_ms": (Memory.LOST, "now_ms"),
    "is_located": (Memory.LOST, "False"),
    "stop": (Memory.LOST, "0"),
    "stands": (Memory.LOST, "False"),
    "holds": (Memory.LOST, "False"),
    "recovers": (Memory.LOST, "False"),
    "made_ms": (Memory.LOST, "now_ms"),
}
"""A tram's display: nothing survives (`kernel.tram.display.begun`)."""

ALARM_UNIT: Mapping[str, tuple[Memory, str]] = {
    "place_mm": (Memory.LOST, "GREATEST_PLACE_MM + 1"),
    "age_ms": (Memory.LOST, "GREATEST_AGE_MS + 1"),
    "direction": (Memory.LOST, "Direction.UNKNOWN"),
    "is_running": (Memory.LOST, "False"),
}
"""The unit that sends a train's place to the track worker's alarm: no fix (`kernel.alarm.distance.NO_TRAIN_FIX`)."""

ALARM_SERVER: Mapping[str, tuple[Memory, str]] = {
    "life_ms": (Memory.LOST, "now_ms"),
    "count": (Memory.LOST, "0"),
    "is_whole": (Memory.LOST, "False"),
    "trains": (Memory.LOST, "{}"),
    "entries": (Memory.LOST, "{}"),
}
"""The display's server: it knows of no train, and says so (`kernel.alarm.train_list.started`)."""

ALARM_HANDSET: Mapping[str, tuple[Memory, str]] = {
    "worker": (Memory.LOST, "NO_WORKER_FIX"),
    "server_age_ms": (Memory.LOST, "GREATEST_AGE_MS + 1"),
    "servers_well": (Memory.LOST, "False"),
    "battery_well": (Memory.LOST, "False"),
    "listing": (Memory.LOST, "Listing(life_ms=-1, taken=0, count=0, is_whole=False, named={})"),
    "trains": (Memory.LOST, "{}"),
}
"""A track worker's handset: nothing survives (`kernel.alarm.tone.switched_on`)."""
