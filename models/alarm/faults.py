"""Faults of a day of a track worker (A1, A2, A8); see :mod:`models.days.faults`."""

from __future__ import annotations

from models.days.faults import Fault

FAULTS = (
    Fault("gps_out", "a train's GPS gave no fix", 0.5, 20, 900, "-", 0, 0, "practice: antenna, leaves, deep cuttings"),
    Fault("gps_jump", "a train's fixes were kilometres off", 0.3, 5, 120, "m", 9_000, 15_000,
          "practice: a receiver that takes a reflection for the sky, or shows an old place"),
    Fault("train_silent", "the unit on a train had no network", 0.5, 20, 300, "-", 0, 0, "practice: valleys"),
    Fault("handset_silent", "the handset had no network", 0.7, 10, 600, "-", 0, 0, "practice: valleys"),
    Fault("slow", "the network was slow", 0.7, 60, 1_800, "s", 2, 9, "practice: evenings, handover from 3G to LTE"),
    Fault("repeats", "messages came twice and out of order", 0.5, 60, 1_800, "-", 0, 0, "practice: retries"),
    Fault("display_out", "the traffic display was silent", 0.2, 20, 600, "-", 0, 0, "practice: its interface restarts"),
    Fault("servers_ill", "the monitoring server said so", 0.1, 60, 900, "-", 0, 0, "practice: one restart in ten days"),
    Fault("own_gps_out", "the worker's GPS gave no fix", 0.6, 10, 300, "-", 0, 0, "practice: beside a wall"),
    Fault("battery", "the battery did not last", 0.1, 600, 3_600, "-", 0, 0, "practice: a cold day"),
    Fault("stands", "a train stood between stations", 0.4, 60, 900, "-", 0, 0, "practice: a signal, a deer"),
    Fault("turns", "a train stood, and ran back where it came from", 0.1, 90, 600, "-", 0, 0, "practice: line blocked"),
    # ---- beyond what is assumed
    Fault("gps_drift", "a train's fixes were off by less than the display tells", 0.0, 600, 3_600, "m", 150, 900,
          "practice: reflections in a cutting", "a_wrong_fix_is_contradicted"),
    Fault("clock", "ages were told too young", 0.0, 600, 3_600, "s", 20, 60, "ours: a unit that lost GPS time",
          "the_train_keeps_the_lines_speed"),
    Fault("unlisted", "a train was reported to have left, and neither source told the server of it", 0.0, 1_800, 7_200,
          "-", 0, 0, "ours: a trolley", "what_is_reported_left_and_silent_has_left"),
    Fault("own_drift", "the worker's fix was off", 0.0, 600, 3_600, "m", 200, 1_500, "practice: a cold start",
          "a_worker_fix_is_within_its_error"),
    Fault("backwards", "a train told the wrong direction", 0.0, 600, 3_600, "-", 0, 0, "ours: a cable swapped",
          "no_train_turns_sooner"),
    # ---- drawn from numbers of its own, so that the days on record stay what they are otherwise
    Fault("gps_frozen", "a train's receiver told the same fix again, with fresh time stamps", 0.3, 60, 1_800, "-", 0, 0,
          "ours: a receiver or its program that repeats its last fix"),
    Fault("joined", "a line joined, and no list had its trains", 0.1, 61_200, 61_200, "m", 1_500, 38_500,
          "practice: a branch, a break of kilometrage, the next line"),
    Fault("gps_creeps", "a train's fixes went off slowly", 0.0, 600, 3_600, "m", 300, 1_500,
          "practice: a receiver that loses satellites one by one", "a_wrong_fix_is_contradicted"),
    Fault("gps_parallel", "a train's fixes were put on a line beside, longer or shorter", 0.0, 600, 3_600, "%", 5, 30,
          "ours: the nearer line of two in the conversion", "a_wrong_fix_is_contradicted"),
    Fault("server_restarts", "the display's server restarted, and so much later a person confirmed its list", 0.1, 10,
          120, "s", 60, 300, "practice: one restart in ten days"),
    Fault("list_cut", "lists of the server were cut on their way", 0.2, 600, 3_600, "-", 0, 0,
          "ours: a connection that breaks off"),
    Fault("renumbered", "a train changed its number on its way", 0.3, 600, 2_400, "-", 0, 0,
          "practice: a train that goes on as another"),
    Fault("handset_restarts", "the handset restarted", 0.2, 1, 1, "-", 0, 0, "practice: its program ends"),
    Fault("broken", "kilometrage broke, by an equation of the register", 0.1, 61_200, 61_200, "m", 1_500, 38_500,
          "practice: a line that was moved, or joined from two"),
    Fault("turns_at_once", "a train turned at each station where it stopped, as soon as any can", 0.05, 600, 3_600,
          "-", 0, 0, "practice: a shuttle between two stations, a terminus"),
    Fault("coupled", "two trains coupled at a station, and one number ended there", 0.05, 3_600, 5_400, "-", 1, 1,
          "practice: trains of two lines that go on as one"),
    Fault("parted", "a train parted at a station, and its rear ran back under a number of its own", 0.05, 3_600, 5_400,
          "-", 0, 0, "practice: cars that are put on for a part of the way"),
    Fault("adjoined", "trains came over the line's end from the next one, on the register as far as it matters", 0.05,
          61_200, 61_200, "m", 10, 1_500, "practice: a worker of the last section of a line"),
    Fault("two_workers", "another worker had a handset, elsewhere beside the line", 0.05, 61_200, 61_200, "m", 1_500,
          38_500, "practice: parties at two places"),
    Fault("branches", "a branch with figures and trains of its own was on the register, which ran onto the line",
          0.05, 61_200, 61_200, "m", 28_200, 34_400, "practice: every junction of two lines"),
)  # fmt: skip
"""In the order of the simulation's windows."""

OF_A_TRAIN = (
    "gps_out", "gps_jump", "train_silent", "stands", "turns", "gps_drift", "clock", "unlisted", "backwards",
    "gps_frozen", "gps_creeps", "gps_parallel", "renumbered", "turns_at_once", "coupled",
    "parted",
)  # fmt: skip
"""Those that begin while the train is under way."""
OF_A_HANDSET = ("handset_silent", "own_gps_out", "battery", "own_drift", "handset_restarts")
"""Those that each worker's handset has by itself."""
OF_THEIR_OWN = frozenset({
    "gps_frozen", "joined", "gps_creeps", "gps_parallel", "server_restarts", "list_cut", "renumbered",
    "handset_restarts", "broken", "turns_at_once", "coupled", "parted",
    "adjoined", "two_workers", "branches",
})  # fmt: skip
"""Those that are drawn from numbers of their own."""
KIND = {fault.name: number for number, fault in enumerate(FAULTS)}
WITHIN = tuple(fault for fault in FAULTS if not fault.breaks)
BEYOND = tuple(fault for fault in FAULTS if fault.breaks)
