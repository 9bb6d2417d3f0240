"""Where everything is that the driver looks at: numbers for the arrays of the state, and the driver's own memory.

The driver has two arrays of words.  ``memory`` is that of the compiled kernel.  ``desk`` is its own: a header, a
table of trains, telegrams under way, a table of places, and what a site's layout says, as dense tables.  A place is
four words: where an array begins and the strides of its axes.  So the driver is compiled once for all layouts.
"""

from __future__ import annotations

from fuzz.traffic.faults import FAULTS

FIELDS: list[str] = []
"""Arrays of the state, by the names of ``fuzz.compiled.memory``; an array's number is its place."""
TABLES: list[str] = []
"""Tables of the desk, numbered on from the arrays of the state."""
MOST_FIELDS = 96


def field(name: str) -> int:
    """Number an array of the state."""
    FIELDS.append(name)
    assert len(FIELDS) <= MOST_FIELDS
    return len(FIELDS) - 1


def table(name: str) -> int:
    """Number a table of the desk."""
    TABLES.append(name)
    return MOST_FIELDS + len(TABLES) - 1


# ---- the header

(
    RANDOM,
    MEMORY,
    STEP,
    STEP_BEYOND,
    JUDGE,
    WHY,
    EVENT,
    BROKEN_NOW,
    STATE_HASH,
    CLOCK,
    ENDED,
    BY,
    STEPS,
    ACCEPTED,
    VIOLATED,
    BROKEN,
    FINISHED,
    DUE,
    RECOVER_AT,
    STUCK_UNTIL,
    TRAINS,
    ON_LINE,
    BLOCK_WORDS,
    BLOCKS,
    ROUTES,
    POINTS,
    TAGS,
    RECORDS,
    TAG_LISTS,
    CARS,
    CABS,
    POSITIONS,
    FOREIGN_TAG,
    FOREIGN_RECORD,
    STANDING,
    LAST_SERIAL,
    MOST_STEPS,
    MOST_ACCEPTED,
    MOST_SECONDS,
    REFUSALS,
    LOG_WIDTH,
    WITHOUT_TRAIN,
    TROUBLES,
    DECISIONS,
    DESK,
    LAST_FINISHED,
    PROGRESS_AT,
) = range(47)
"""Words of the desk's header; ``BY`` is the fault at work or -1, ``TROUBLES`` how many come by the second."""
ENTRIES, MOST_ENTRIES = 64, 80
"""Addresses of the driver's own functions."""
HEADER = ENTRIES + MOST_ENTRIES

# ---- faults, by their number

COUNT = len(FAULTS)
PRESENT = HEADER
"""Chance per occasion in this trace, in parts of 2**32; 0 where the fault is absent."""
DRAWN = PRESENT + COUNT
"""How often each was at work, over a batch."""
CARRIED = DRAWN + COUNT
"""How many traces had it, over a batch."""
STANDSTILL = CARRIED + COUNT
"""Train seconds at rest by cause, over a batch: one word for each fault, then these."""
BY_TIMETABLE = COUNT
BY_TRAFFIC = COUNT + 1
BY_START = COUNT + 2
CAUSES = COUNT + 3
TROUBLE = STANDSTILL + CAUSES
"""The faults of this trace that come by the second."""

# ---- trains

MOST_TRAINS = 16
MOST_CARS = 8
MOST_TRAIL = 24
(
    PHASE,
    BASE,
    RUN,
    ONWARD,
    WAKE,
    PATIENCE,
    DONE,
    WANTED,
    CAUSE,
    LENGTH,
    LEADS,
    FIRST,
    MOVING,
    TUPLE,
    TELLING,
    DEAD_HEAD,
    DEAD_TAIL,
    LINE,
    WAITING,
    START,
) = range(20)
"""Words of a train: see ``journey``.  ``WAKE``, ``DEAD_HEAD``, ``DEAD_TAIL``, ``LINE`` are seconds of the clock."""
TRAIL = 20
JOINTS = TRAIL + MOST_TRAIL
LOWEST = JOINTS + MOST_TRAIL
HIGHEST = LOWEST + MOST_CARS
TRAIN_WORDS = HIGHEST + MOST_CARS
TRAIN = TROUBLE + COUNT
NOBODY = MOST_TRAINS
"""What no train did is told of this one more."""

# ---- telegrams under way

LATE = TRAIN + (MOST_TRAINS + 1) * TRAIN_WORDS
MOST_LATE = 64
LATE_WORDS = 16
"""Due, kind, fault, train, and up to 12 words."""

PLACES = LATE + MOST_LATE * LATE_WORDS
TABLES_FROM = PLACES + 4 * 192

# ---- arrays of the state

RUNS_SERIAL = field("runs_serial")
RUNS_TRAIN = field("runs_train")
RUNS_LIFE = field("runs_life")
RUNS_ROUTE = field("runs_route")
RUNS_COUNT = field("runs_count")
CENTRE_EPOCH = field("centre_epoch")
CENTRE_NEWEST = field("centre_newest")
CENTRE_ACCOUNTED = field("centre_accounted")
CENTRE_ACCOUNTED_VALUE = field("centre_accounted_value")
CENTRE_RUNS = field("centre_runs")
CENTRE_RUNS_STAGE = field("centre_runs_stage")
CENTRE_RUNS_PROVED = field("centre_runs_proved")
CENTRE_CLAIMED_VALUE = field("centre_claimed_value")
CENTRE_LOST_BLOCKS = field("centre_lost_blocks")
CENTRE_LOST_POINTS = field("centre_lost_points")
CENTRE_TERMINAL_LIFE = field("centre_terminal_life")
CENTRE_TERMINAL_LIFE_VALUE = field("centre_terminal_life_value")
UNITS_LIFE = field("units_life")
UNITS_ANSWERED = field("units_answered")
UNITS_LOOP_OPEN = field("units_loop_open")
UNITS_LEADING = field("units_leading")
UNITS_ORDERS = field("units_orders")
UNITS_PERMITTED = field("units_orders_permitted")
UNITS_GIVEN_BACK = field("units_orders_given_back")
UNITS_STOPPED = field("units_orders_stopped")
UNITS_LEFT = field("units_orders_left")
UNITS_LEFT_LEFT_TAG = field("units_orders_left_left_tag")
UNITS_LEFT_LEFT_RECORD = field("units_orders_left_left_record")
UNITS_LEFT_ENTERED_TAG = field("units_orders_left_entered_tag")
UNITS_LEFT_ENTERED_RECORD = field("units_orders_left_entered_record")
TERMINALS_LIFE = field("terminals_life")
TERMINALS_WANTED = field("terminals_wanted")
TERMINALS_UNLOCKED = field("terminals_unlocked")
RADIO_ORDERS = field("radio_orders")
RADIO_RELAYED_ORDERS = field("radio_relayed_orders")
RADIO_ENQUIRIES = field("radio_enquiries")
RADIO_RELAYED_ENQUIRIES = field("radio_relayed_enquiries")
RADIO_CONFIRMED = field("radio_confirmed")
RADIO_CONFIRMATIONS = field("radio_confirmations")
LAYOUT_TAG_LIST_VALUE = field("layout_tag_list_value")
UNITS_TAG_LIST = field("units_orders_tag_list")
RADIO_OFFERS = field("radio_offers")
RADIO_ECHOES = field("radio_echoes")
RADIO_PERMITS = field("radio_permits")
RADIO_RECALLS = field("radio_recalls")
RADIO_RETURNS = field("radio_returns")
RADIO_STOPS = field("radio_stops")
RADIO_STANDING_RUNS = field("radio_standing_runs")
RADIO_STANDINGS = field("radio_standings")
RADIO_STATEMENTS = field("radio_statements")
RADIO_CONFIRMED_STATEMENTS = field("radio_confirmed_statements")
RADIO_TERMINAL_LIVES = field("radio_terminal_lives")
RADIO_TAIL_REPORTS = field("radio_tail_reports")
RADIO_TAIL_REPORTS_COUNT = field("radio_tail_reports_count")
TRACK_AT = field("track_at")
TRACK_AT_VALUE = field("track_at_value")
TRACK_ROLLING = field("track_rolling")
TRACK_SLIPPING = field("track_slipping")
TRACK_FACING = field("track_facing")
TRACK_FACING_VALUE = field("track_facing_value")
TRACK_UNREAD = field("track_unread")
TRACK_LIES_VALUE = field("track_lies_value")
TRACK_PARTED = field("track_parted")

# ---- tables of the desk

WAY = table("way")
"""[route, block]: the next block of the route, or -1."""
BOUNDARY = table("boundary")
"""[route, block]: the tag of the route at the end of the block, or -1."""
START_OF = table("start")
DESTINATION = table("destination")
CLAIMS = table("claims")
"""[route, words]: bits of blocks; the overlap likewise."""
OVERLAP = table("overlap")
NEEDS = table("needs")
"""[route]: how many points; ``NEEDED``: [route, place], ``NEED``: [route, point] the position or -1."""
NEEDED = table("needed")
NEED = table("need")
FROM = table("from")
"""[block]: how many routes begin there; ``FROM_ROUTE``: [block, place]."""
FROM_ROUTE = table("from_route")
LEADING = table("leading")
"""[route, train]: 1 where the first of the train's cars leads."""
PARTNER = table("partner")
TAG_IN = table("tag_in")
"""[tag]: the block or -1."""
RECORD = table("record")
STANDS_IN = table("stands_in")
"""[point]: the block that it stands in."""
LEGS = table("legs")
"""[point]: how many positions; ``LEG``: [point, place]."""
LEG = table("leg")
FOULS = table("fouls")
"""[block, words]: bits of blocks, itself among them."""
NEIGHBOURS = table("neighbours")
"""[block]: how many; ``NEIGHBOUR``: [block, place]."""
NEIGHBOUR = table("neighbour")
BERTHS = table("berths")
"""[1]: how many blocks a train may begin in; ``BERTH``: those without points first, ``PLAIN``: how many these are."""
BERTH = table("berth")
PLAIN = table("plain")
CAR_COUNT = table("car_count")
CAR = table("car")
"""[train, place]: the car; ``CAB``: [car], ``TRAIN_OF``: [car]."""
CAB = table("cab")
TRAIN_OF = table("train_of")
WORDS = table("words")
"""[kind]: how many words an event has; ``TYPES``: [kind, word] of ``tables``; ``RUN_AT``: the run's word or -1."""
TYPES = table("types")
RUN_AT = table("run_at")
TRAIN_AT = table("train_at")
"""[kind]: the train's word; with ``TRAIN_BY``: what that word is (run, train, car or nothing)."""
TRAIN_BY = table("train_by")
ARRIVALS = table("arrivals")
"""[arrival, 8]: kind, array, sizes of its axes, and the words of the event for them and for the bit."""
QUANTILE = table("quantile")
"""[fault, quantile]: chances in parts of 2**32."""
WEIGHTED = table("weighted")
"""[fault]: how many traces have it, in parts of 2**32, by the weights."""
FAULT_IS = table("fault_is")
"""[fault]: 1 where it comes by the second, 2 where it is beyond the assumptions, or both together."""
HITS = table("hits")
PAIRS = table("pairs")
SKETCH = table("sketch")
LOG = table("log")
"""[accepted step]: kind, fault, beyond, and the words; a run is its four fields."""
START_AT = table("start_at")
"""[car]: the block it begins in or -1; ``START_LIES``: [point]."""
START_LIES = table("start_lies")
