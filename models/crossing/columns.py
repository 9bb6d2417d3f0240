"""What is counted of each day at a crossing, by name (X2 to X6)."""

from __future__ import annotations

from collections.abc import Mapping

from models.crossing.faults import FAULTS

CLAIMS: Mapping[str, str] = {
    "late_warning": "an arrival warned of for less than the warning time (X2, X5)",
    "short_closure": "an arrival with the arms down for less than 15 s (X5)",
    "lifted_between": "an arrival too soon after an opening at which its train was known (X4)",
    "opened_before_rear": "a warning ended while a train that was warned of was not past (X4)",
    "unwarned_silence": "a start point's terminal was silent for too long without a warning (T14)",
    "beyond_ceiling": "seconds in which a train in contact was faster than the crossing held it to be (X2)",
    "wrong_striker": "strikes put down to a train that did not make them (X3, T14)",
    "opened_unseen": "seconds with the road open and a track that nobody had seen empty since a start (X3)",
    "latched": "days that ended with the road closed and no train under way (X4)",
}
ASSUMPTIONS: Mapping[str, str] = {
    "ranging_broken": "`the_ranging_bounds_the_train`: a train was nearer or faster than its ranging said",
    "age_broken": "`a_ranging_is_no_older_than_it_says`",
    "gain_broken": "`the_train_gains_no_more`, `the_train_keeps_to_its_ceiling`",
    "strike_broken": "`the_terminal_tells_every_strike_first`: one was missed",
    "rear_broken": "`a_whole_train_told_gone_is_gone`",
    "account_broken": "`a_person_accounts_for_a_track_seen_empty`: a train was there",
    "arms_broken": "`the_arms_come_down_in_time`",
    "start_broken": "`who_arrives_has_passed_the_start_point`, and it lies far enough; or it was let go at a signal",
    "track_broken": "`a_train_comes_on_a_track`: seconds with the road open and a track that nothing had told of",
}
MONITORS: Mapping[str, str] = {
    "lost": "trains of which the ranging was lost before they were past (X3)",
    "contradicted": "rangings that contradicted the one before of a train that was not past: warned of at once (X1)",
    "silences": "warnings for a start point's silent terminal (T14)",
    "conventional": "trains under conventional control (X3)",
    "unread": "strikes of trains in contact of which no read of the start tag was told: warned of at once (X3, T14)",
    "released": "trains that a person released (X4)",
    "forgotten": "trains between start point and road when power failed (X3)",
    "accounted": "tracks that a person accounted for after power had failed, or as a terminal had started (X3)",
    "owed": "starts of a terminal that told that it may have missed strikes (X3, T14)",
    "missed": "strikes that it did not note, or had not told of (X3)",
}
PRICES: Mapping[str, str] = {
    "closed_s": "seconds for which the crossing warned",
    "unseen_s": "of them with a track that nobody had seen empty since power failed, or a terminal started",
    "old_closed_s": "seconds for which the old crossing would have",
    "beyond_s": "seconds of warning before arrivals beyond the warning time, all trains",
    "old_beyond_s": "the same of the old crossing",
    "closed_beside_s": "seconds for which the second road warned, where one lay close to the first",
    "needless": "warnings in which no train arrived",
    "held": "openings of less than the least time that were not made: arms stayed down for a near train",
    "old_short_openings": "openings of less than the least time that the old crossing would have made",
}
COUNTS: Mapping[str, str] = {
    "trains": "trains that came",
    "arrivals": "heads at the crossing",
    "in_contact": "of them in contact, and never lost",
    "arrivals_beside": "heads at the second road, where one lay close to the first",
    "warnings": "warnings that began",
    "likely_late": "arrivals that the paper's reckoning, without bounds, would have warned of late",
    "turned_back": "trains in contact that were let go as they turned back before their start point (X4)",
    "came_back": "trains that stood beyond the road, were let go and came back (X4)",
    "rangings": "rangings that counted",
    "promised": "trains that promised a ceiling (X2)",
    "asked_faster": "of them that asked to go faster",
    "let_faster": "of those that were let",
    "seconds": "seconds of traffic",
}
DRAWN: Mapping[str, str] = {f"fault_{fault.name}": fault.says for fault in FAULTS}

COLUMNS = (*CLAIMS, *ASSUMPTIONS, *MONITORS, *DRAWN, *PRICES, *COUNTS)
"""In the order of ``models.days.system.System.columns``."""
NUMBER = {name: number for number, name in enumerate(COLUMNS)}
