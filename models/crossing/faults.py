"""Faults of a day at a crossing (X1, X3, T14); see :mod:`models.days.faults`."""

from __future__ import annotations

from models.days.faults import Fault

FAULTS = (
    Fault("radio_out", "no ranging of any train", 0.3, 3, 300, "-", 0, 0, "practice: interference in 2.4 GHz"),
    Fault("lossy", "most rangings were lost", 0.5, 60, 1_800, "1", 0.3, 0.8, "practice: a van with a transmitter"),
    Fault("multipath", "multipath at its bound, of one sign", 0.6, 300, 3_600, "1", -1, 1, "practice: wet facades"),
    Fault("late", "rangings came late", 0.5, 60, 1_800, "cycles", 1, 2, "ours: a loaded ground unit"),
    Fault("repeated", "rangings came twice", 0.5, 60, 1_800, "cycles", 1, 2, "ours: retries"),
    Fault("terminal", "a start point's terminal was silent", 0.2, 1, 120, "-", 0, 0, "practice: a cable, a restart"),
    Fault("end_tags", "tails missed the end tags", 0.4, 600, 7_200, "-", 0, 0, "practice: dirt, a tag that came off"),
    Fault("end_detector", "the end detector told of no train", 0.1, 600, 3_600, "-", 0, 0, "practice: one in ten days"),
    Fault("late_contact", "contact was made late", 0.6, 600, 7_200, "m", 100, 900, "practice: shadowing"),
    Fault("no_radio", "trains without radio", 1.0, 68_400, 68_400, "1", 0.02, 0.20, "practice: other lines' trains"),
    Fault("stops_short", "a train stood before the crossing", 0.5, 30, 600, "m", 20, 900, "practice: a signal, a door"),
    Fault("turns_back", "a train turned back before the road", 0.1, 30, 200, "m", 300, 1_900, "practice: possession"),
    Fault("sprints", "a train came slowly and then gained all it could", 0.5, 0, 0, "m", 300, 1_100, "worst case"),
    # ---- beyond what is assumed
    Fault("reflection", "rangings were off by more than their bound", 0.0, 3_600, 14_400, "m", 150, 400,
          "practice: the direct way is hidden", "the_ranging_bounds_the_train"),
    Fault("stale", "old rangings were told as new", 0.0, 3_600, 14_400, "cycles", 6, 12, "ours: a wrong order number",
          "a_ranging_is_no_older_than_it_says"),
    Fault("unstruck", "a start point missed trains", 0.0, 7_200, 28_800, "-", 0, 0, "ours: a broken detector",
          "the_terminal_tells_every_strike_first"),
    Fault("parts", "parts of trains stayed behind, and none was missed", 0.0, 3_600, 14_400, "s", 30, 90,
          "ours: a coupler and the through line", "a_whole_train_told_gone_is_gone"),
    Fault("slow_arms", "arms came down late", 0.0, 7_200, 28_800, "s", 8, 20, "practice: frost",
          "the_arms_come_down_in_time"),
    Fault("strong", "a train gained more than any should", 0.0, 0, 0, "m", 300, 1_100, "ours: a locomotive alone",
          "the_train_gains_no_more"),
    # ---- drawn apart: a day's other draws are the same with these and without
    Fault("power", "power failed at the crossing", 0.2, 1, 900, "s", 60, 900, "practice: lightning, a battery"),
    Fault("unlooked", "power failed, and nobody looked at the tracks", 0.0, 1, 60, "-", 0, 0, "ours: a hurried person",
          "a_person_accounts_for_a_track_seen_empty"),
    # ---- start points, and who comes to them
    Fault("start_tags", "heads missed start tags", 0.4, 600, 7_200, "-", 0, 0, "practice: dirt, a tag that came off"),
    Fault("late_reads", "reads of start tags were told late, and again", 0.5, 600, 7_200, "s", 1, 2, "ours: retries"),
    Fault("beside", "trains without radio ran beside trains in contact", 0.3, 3_600, 10_800, "-", 0, 0,
          "practice: two tracks"),
    Fault("close_behind", "trains without radio came close behind trains in contact", 0.3, 3_600, 10_800, "-", 0, 0,
          "practice: a late train"),
    Fault("close_roads", "a second road lay so close to the first", 0.3, 68_400, 68_400, "m", 250, 700,
          "practice: two streets of a town"),
    Fault("late_words", "a terminal's words were under way for seconds", 0.3, 600, 7_200, "s", 1, 2,
          "practice: a relay, retries"),
    Fault("terminal_restarts", "a start point's terminal had no power, and may have missed strikes", 0.3, 1, 120,
          "s", 60, 900, "practice: a cable, a restart"),
    Fault("unlisted", "the crossing started with settings that left a track out", 0.1, 1, 60, "s", 150, 900,
          "ours: a hurried person"),
    Fault("turns_beyond", "a train stopped beyond the road, changed ends and came back", 0.3, 60, 600, "m", 60, 900,
          "practice: a single line, shunting"),
    Fault("unasked", "a train stopped beyond the road, and came back without asking to start", 0.0, 60, 600, "m", 60,
          300, "ours: a place without a signal", "who_arrives_has_passed_the_start_point"),
)  # fmt: skip
"""In the order of the simulation's windows.

``power``, ``terminal_restarts`` and ``unlisted`` are as large as a person takes to come once power is back.
"""

DRAWN_APART = (
    "power", "unlooked", "start_tags", "late_reads", "beside", "close_behind", "close_roads", "late_words",
    "terminal_restarts", "unlisted", "turns_beyond", "unasked",
)  # fmt: skip

KIND = {fault.name: number for number, fault in enumerate(FAULTS)}
