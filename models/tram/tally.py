"""What is counted of each day of trams, by name (G2 to G6)."""

from __future__ import annotations

from collections.abc import Mapping

from models.tram.faults import FAULTS

CLAIMS: Mapping[str, str] = {
    "recovery_occupied": "seconds in which a driver might recover with a tram ahead up to the next stop, or at it (G5)",
    "recovery_unknown": "orders to recover while a tram ahead had not left the next stop, or had not told so (G5)",
    "order_by_guess": "orders to a tram that had not told within 11 s that it stands there (G6)",
    "hold_and_recovery": "seconds in which a driver was shown both (G4)",
    "recovery_beyond": "seconds in which a recovery lasted beyond the next stop (G5)",
    "order_stale": "seconds in which a standing tram was shown an order that was made longer ago than it may be (G6)",
    "wrong_tram": "orders taken by another tram than they were for (G6)",
    "order_turned": "seconds in which reports had shown two trams in another order than that on the track (G2)",
    "reached_too_soon": "seconds in which a unit had reached, or left, a stop that the tram had not (G2)",
    "wandered": "fixes that made a tram run that stood (G2)",
}
ASSUMPTIONS: Mapping[str, str] = {
    "place_broken": "`a_place_is_within_its_error`: fixes that erred by more than is declared",
    "speed_broken": "`a_speed_is_within_its_error`: speeds that did",
    "overtaken": "`none_overtakes`: seconds in which one tram was beside or before the one ahead of it",
    "unannounced": "`a_tram_comes_where_and_when_it_was_confirmed`: trams that came without, or after it had lapsed",
    "taken_off_there": "`who_is_taken_off_is_off_the_way`: trams taken off by hand that were on the way",
    "clock_broken": "`clocks_keep_gps_time`: seconds in which a unit's clock was off",
    "report_broken": "`a_report_tells_where_it_is`: reports from beyond where the tram was",
    "frame_broken": "`the_frame_carries_the_order`: orders written with another time than that at which they were made",
}
MONITORS: Mapping[str, str] = {
    "reports_refused": "reports that were not taken: too old, backwards, of a run before",
    "unheard": "cycles in which a station had no answer from a tram that stood there",
    "place_lost": "seconds of trams without a place",
    "orders_lapsed": "orders that lapsed at a stop because none followed",
    "not_taken_up": "seconds that a tram waited to come midway, as one behind might recover or the way was not known",
    "confirmed_anew": "trams whose confirmation had lapsed before they came, and which asked again",
    "taken_off": "trams that a person took off, since they did not tell from elsewhere",
    "not_known_s": "seconds of trams on the way that the centre did not know, after it had started anew",
    "beyond_destination": "reports from beyond the stop where the tram was to leave: a wrong setting",
    "given_up": "trams that waited half an hour to come back, were not confirmed, and went to the depot",
    "of_the_future": "orders that a tram did not take, as they were of the future by its clock",
    "not_taken_up_anew": "requests to take up a tram that was on the way, refused",
    "contradicted": "pairs of trams that reports had shown in either order: neither recovers behind the other",
}
PRICES: Mapping[str, str] = {
    "held_s": "seconds for which trams were held when they could have departed",
    "needless_s": "of these, seconds in which the truth gave no reason to hold",
    "recoveries_due": "orders at which the truth would have let the tram recover",
    "recoveries_not_given": "of these, orders that did not let it, because something was not known",
    "recovery_s": "seconds run in recovery",
}
COUNTS: Mapping[str, str] = {
    "runs": "runs from the first stop or the depot",
    "departures": "departures from stops",
    "orders": "orders made",
    "orders_to_hold": "orders to hold",
    "orders_to_recover": "orders to recover",
    "frames": "answers of trams asked for",
    "tram_s": "seconds of trams on the way",
    "stood_s": "seconds at stops",
    "turned": "trams that turned at the far terminus and came back",
    "joined": "trams of the other line that joined at the junction",
    "set_wrong": "units that started anew under way and were set to the other way",
    "set_too_soon": "of these, units of trams that had been confirmed for that one",
}
COLUMNS = (*CLAIMS, *ASSUMPTIONS, *MONITORS, *(f"fault_{name}" for name in FAULTS), *PRICES, *COUNTS)

RECOVERY_OCCUPIED, RECOVERY_UNKNOWN, ORDER_BY_GUESS, HOLD_AND_RECOVERY = map(COLUMNS.index, list(CLAIMS)[:4])
RECOVERY_BEYOND, ORDER_STALE, WRONG_TRAM, ORDER_TURNED = map(COLUMNS.index, list(CLAIMS)[4:8])
REACHED_TOO_SOON, WANDERED = map(COLUMNS.index, list(CLAIMS)[8:])
PLACE_BROKEN, SPEED_BROKEN, OVERTAKEN, UNANNOUNCED = map(COLUMNS.index, list(ASSUMPTIONS)[:4])
TAKEN_OFF_THERE, CLOCK_BROKEN, REPORT_BROKEN, FRAME_BROKEN = map(COLUMNS.index, list(ASSUMPTIONS)[4:])
REPORTS_REFUSED, UNHEARD, PLACE_LOST, ORDERS_LAPSED, NOT_TAKEN_UP = map(COLUMNS.index, list(MONITORS)[:5])
CONFIRMED_ANEW, TAKEN_OFF, NOT_KNOWN_S, BEYOND_DESTINATION, GIVEN_UP = map(COLUMNS.index, list(MONITORS)[5:10])
OF_THE_FUTURE, NOT_TAKEN_UP_ANEW, CONTRADICTED = map(COLUMNS.index, list(MONITORS)[10:])
HELD_S, NEEDLESS_S, RECOVERIES_DUE, RECOVERIES_NOT_GIVEN, RECOVERY_S = map(COLUMNS.index, PRICES)
RUNS, DEPARTURES, ORDERS, ORDERS_TO_HOLD, ORDERS_TO_RECOVER = map(COLUMNS.index, list(COUNTS)[:5])
FRAMES, TRAM_S, STOOD_S, TURNED, JOINED, SET_WRONG, SET_TOO_SOON = map(COLUMNS.index, list(COUNTS)[5:])
