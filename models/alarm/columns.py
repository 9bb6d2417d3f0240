"""What is counted of each day of the alarm, by name; in seconds of the worker's time where nothing else is said."""

from __future__ import annotations

from collections.abc import Mapping

from models.alarm.faults import FAULTS

CLAIMS: Mapping[str, str] = {
    "normal_within_3000_s": "the normal tone with a train within 3000 m that had not departed (A3)",
    "normal_within_100_past_s": "the normal tone with a part of a train less than 100 m away (A3)",
    "caution_within_1500_s": "caution and no alarm with a train within 1500 m that had not departed (A3)",
    "mild_unknown_s": "normal or caution with a train on the line that was not on the list or not known (A2, A8)",
    "mild_in_section_s": "normal or caution in a section that is not to be used (A4, A5, A6)",
}
ASSUMPTIONS: Mapping[str, str] = {
    "wrong_fix_believed_s": "`a_wrong_fix_is_contradicted`: a wrong fix agreed with the display, or with shunting",
    "age_broken": "`the_train_keeps_the_lines_speed`: a report whose train had got farther than its age allows",
    "speed_broken": "`all_trains_keep_the_lines_speed`: a train that was faster",
    "own_fix_broken": "`a_worker_fix_is_within_its_error`",
    "walk_broken": "`the_worker_keeps_a_walking_speed`",
    "display_broken": "`the_display_shows_where_the_train_was`",
    "turning_broken_s": "`no_train_turns_sooner`: a train that counted by a direction in which it did not run",
    "list_broken": "`who_confirms_has_entered_every_train`: a list was whole, and a train of the line not on it, s",
    "left_broken": "`what_is_reported_left_and_silent_has_left`: a train of the line was taken off the list",
    "unnamed_s": "`a_train_comes_after_it_was_let_on`: a whole list was fresh, and a train of the line not on it",
    "length_broken": "`no_train_is_longer_than_written`",
}
MONITORS: Mapping[str, str] = {
    "jumped": "two fixes of a train farther apart than its speed allows",
    "turned": "a report of the other direction within the time of turning",
    "mismatch_s": "a train that was not known as it should be: neither both sources nor one as registered (A2)",
    "unlinked_s": "the list was too old (A8)",
    "short_s": "the list was short: entries of it had not come (A1)",
    "not_whole_s": "the server said that its list was not whole (A1)",
    "ill_s": "the monitoring server spoke of ill servers (A1)",
    "no_own_fix_s": "the worker's fix was too old (A8)",
    "battery_s": "the battery did not last (A8)",
}
PRICES: Mapping[str, str] = {
    "needless_alarm_s": "alarm with no train within 1500 m but departed ones, s",
    "needless_caution_s": "caution with no train within 3000 m but departed ones, s",
    "needless_fault_s": "fault tone outside of sections with no train within 3000 m but departed ones, s",
    "no_use_s": "the worker was in a section that is not to be used, s",
    "fault_tones": "fault tones that began",
}
COUNTS: Mapping[str, str] = {
    "seconds": "seconds of traffic",
    "normal_s": "normal tone, s",
    "caution_s": "caution, s",
    "alarm_s": "alarm, s",
    "fault_s": "fault tone, s",
    "within_1500_s": "a train was within 1500 m and had not departed, s",
    "within_3000_s": "a train was within 3000 m and had not departed, s",
    "passed": "trains that passed the worker",
    "messages": "messages that reached the handset",
}
DRAWN: Mapping[str, str] = {f"fault_{fault.name}": fault.says for fault in FAULTS}

COLUMNS = (*CLAIMS, *ASSUMPTIONS, *MONITORS, *DRAWN, *PRICES, *COUNTS)
"""In the order of ``models.days.system.System.columns``."""
NUMBER = {name: number for number, name in enumerate(COLUMNS)}
