"""What is counted of each day of trams, by name (G2 to G6)."""

from __future__ import annotations

from collections.abc import Mapping

from models.tram.faults import FAULTS

CLAIMS: Mapping[str, str] = {
    "recovery_occupied": "seconds in which a driver might recover with a tram ahead up to the next stop, or at it (G5)",
    "recovery_unknown": "orders to recover while a tram ahead had not been told to have left the next stop (G5)",
    "order_by_guess": "orders to a tram that had not told within 11 s that it stands there (G6)",
    "hold_and_recovery": "seconds in which a driver was shown both (G4)",
    "recovery_beyond": "seconds in which a recovery lasted beyond the next stop (G5)",
    "order_stale": "seconds in which a standing tram was shown an order older than it may be (G6)",
    "wrong_tram": "orders taken by another tram than they were for (G6)",
    "order_turned": "seconds in which the centre's order of two trams was not that on the track (G2)",
    "reached_too_soon": "seconds in which a unit had reached, or left, a stop that the tram had not (G2)",
    "wandered": "fixes that made a tram run that stood (G2)",
}
ASSUMPTIONS: Mapping[str, str] = {
    "place_broken": "`a_place_is_within_its_error`: fixes that erred by more than is declared",
    "speed_broken": "`a_speed_is_within_its_error`: speeds that did",
    "overtaken": "`trams_are_in_their_turn`: seconds in which one tram was beside or before the one ahead of it",
    "unannounced": "`the_centre_knows_it_before_it_comes`: seconds of a tram on the way that the centre did not know",
    "clock_broken": "`clocks_keep_gps_time`: seconds in which a unit's clock was off",
    "report_broken": "`a_report_tells_where_it_was`: reports from beyond where the tram was",
}
MONITORS: Mapping[str, str] = {
    "reports_refused": "reports that were not taken: too old, backwards, of a run before",
    "unheard": "cycles in which a station had no answer from a tram that stood there",
    "place_lost": "seconds of trams without a place",
    "orders_lapsed": "orders that lapsed at a stop because none followed",
    "not_taken_up": "trams from the depot that had to wait because one behind them might recover",
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
}
COLUMNS = (*CLAIMS, *ASSUMPTIONS, *MONITORS, *(f"fault_{name}" for name in FAULTS), *PRICES, *COUNTS)

RECOVERY_OCCUPIED, RECOVERY_UNKNOWN, ORDER_BY_GUESS, HOLD_AND_RECOVERY = map(COLUMNS.index, list(CLAIMS)[:4])
RECOVERY_BEYOND, ORDER_STALE, WRONG_TRAM, ORDER_TURNED = map(COLUMNS.index, list(CLAIMS)[4:8])
REACHED_TOO_SOON, WANDERED = map(COLUMNS.index, list(CLAIMS)[8:])
PLACE_BROKEN, SPEED_BROKEN, OVERTAKEN, UNANNOUNCED, CLOCK_BROKEN, REPORT_BROKEN = map(COLUMNS.index, ASSUMPTIONS)
REPORTS_REFUSED, UNHEARD, PLACE_LOST, ORDERS_LAPSED, NOT_TAKEN_UP = map(COLUMNS.index, MONITORS)
HELD_S, NEEDLESS_S, RECOVERIES_DUE, RECOVERIES_NOT_GIVEN, RECOVERY_S = map(COLUMNS.index, PRICES)
RUNS, DEPARTURES, ORDERS, ORDERS_TO_HOLD, ORDERS_TO_RECOVER, FRAMES, TRAM_S, STOOD_S = map(COLUMNS.index, COUNTS)
