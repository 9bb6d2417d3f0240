"""The two field trials as sets of parameters: lines, trains, radio, and how the old crossing is triggered (X1 to X6).

Written down before any figure was made, but for the three numbers of promises.  Where the paper is silent, the lines'
public figures or practice stand in; nothing is fitted to the paper's answer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import end_point, start_point
from kernel.crossing.arrival import ArrivalBounds
from kernel.crossing.crossing import Settings, are_lawful, have_one_warning_time
from kernel.crossing.end_point import EndPointSettings
from kernel.crossing.ranging_schedule import ChannelSettings, are_in_time, longest_apart_ms
from kernel.crossing.start_point import StartPointSettings
from kernel.names import Tag
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.ceiling import gained_um_s

CYCLE_S = 1
"""The ground unit decides once a second (ours; the paper does not say)."""
WARNING_S = 35
"""15 s to barriers down and then 20 s: both standards (003, 2.1, note 2)."""
SETTINGS = Settings(
    cycle_ms=1_000,
    warning_cycles=WARNING_S,
    bell_cycles=5,
    lowering_cycles=10,
    least_down_cycles=20,
    lifting_cycles=6,
    reopening_cycles=20,
    silence_cycles=2,
    start_cycles=WARNING_S + 4,
)
"""Bell 5 s and lowering 10 s: 15 s.  Lifting takes 6 s; a road that would be open for less than 20 s stays shut (ours).

The start points are further off than the old crossing's: by what a terminal may be silent, and two cycles.
"""
CHANNEL = ChannelSettings(tick_ms=10, slot_ms=100, most_pairs=17)
"""Ten rangings a second, by radios of 2.4 GHz whose order may pass a few relays (ours; the paper gives no times).

So many pairs may wait for their turn and a ranging that counts for three cycles is not lost.
"""
START_POINT = StartPointSettings(Tag("before the detector"), told_cycles=2, waits_cycles=20, changes_cycles=60)
"""What is told of a tag is no older than 2 s; 20 s is from the tag to the detector at 3 m/s; no train is there within a
minute of one that has turned back (practice)."""
END_POINT = EndPointSettings(Tag("inner"), Tag("outer"), apart_cycles=20, told_cycles=3, changes_cycles=60)
"""The tags lie 5 m apart: 20 s is at 0.25 m/s; no train changes ends within a minute (practice)."""
EXCESS = 1.05
"""A driver may exceed a limit by so much before the line's train protection brakes (ours, typical)."""


# The numbers of promises are calibrated: trials with others (no margin, 2 %, 5 %, 0.5 m/s) had been seen before.

OWN_WAY_M = 5.0
"""A train's own range reaches so far to either side of its head: a tag each few hundred metres, and a wheel."""
OWN_SPEED_M_S = 0.3
"""And its speed's range so far to either side, by wheel and inertial sensor."""
BRAKE = BrakeBounds(
    gains_mm_s2=950, slows_mm_s2=600, response_cycles=15, standstill_mm_s=700, cut_cycles=4, falls_mm_s2=150
)
"""What the trains of both sites are held to by their computers: motors cut off within 0.4 s (ours, typical)."""
CEILING_OVER_M_S = 1.0
"""A promised ceiling is so much above what the driver keeps to: 0.3 m/s of the speed's range, and what a train gains
before the brake responds that keeps it to the ceiling (`kernel.onboard.ceiling.gained_um_s`: 0.65 m/s)."""


@dataclass(frozen=True)
class Kind:
    """One kind of train.

    ``limit_m_s``: its greatest speed before the crossing.  ``cars``: of 20 m.  ``stops``: at both stations.
    """

    limit_m_s: float
    cars: int
    stops: bool


@dataclass(frozen=True)
class Trial:
    """One crossing with the tracks, trains and radio before it; two tracks, alike.

    ``express``, ``local``: kinds of trains, ``express_share`` of them the first.
    ``tells_kinds``: the old crossing has a start point for each kind (003, 3.1).
    ``station_m``: the head's stop before the crossing, and as far beyond.
    ``block_m``: from signal to signal.
    ``gain_m_s2``: the most that any train gains, descent included.
    ``trains``: each hour from the first on, in each direction.
    ``dwell_s``, ``share``: stops, and speed as a share of the limit: off-peak from and to, at the peak from and to.
    ``way_sigma_m``, ``multipath_m``, ``speed_sigma_m_s``, ``loss``: of ranging; a bias of so much either way.
    ``excess``: how far a limit may be exceeded.
    ``likely_m_s2``: what the paper's reckoning takes a train to gain from a standstill: 3.3 km/h/s (practice).
    ``brakes_m_s2``: the most that a driver slows down by (practice).
    ``loss``: seconds in which none of the radios in reach brings a ranging.
    ``own_way_error_m``, ``own_speed_error_m_s``: of the range that a train that promises tells in place of a ranging.
    ``warning_s``: the crossing's warning time; ``settings`` are those of it.  The old crossing's is always 35 s.
    ``ceiling_over_m_s``: what it promises is so much above what its driver keeps to.
    """

    name: str
    express: Kind
    local: Kind
    express_share: float
    tells_kinds: bool
    station_m: float
    block_m: float
    gain_m_s2: float
    trains: tuple[int, ...]
    dwell_s: tuple[int, int, int, int]
    share: tuple[float, float, float, float]
    way_sigma_m: float
    multipath_m: float
    speed_sigma_m_s: float
    loss: float
    excess: float = EXCESS
    likely_m_s2: float = 0.92
    brakes_m_s2: float = 1.2
    warning_s: int = WARNING_S
    own_way_error_m: float = OWN_WAY_M
    own_speed_error_m_s: float = OWN_SPEED_M_S
    ceiling_over_m_s: float = CEILING_OVER_M_S

    @property
    def settings(self) -> Settings:
        """What is written for the crossing: with another warning time the arms are down for less or more of it."""
        longer = self.warning_s - WARNING_S
        return replace(
            SETTINGS,
            warning_cycles=SETTINGS.warning_cycles + longer,
            least_down_cycles=SETTINGS.least_down_cycles + longer,
            start_cycles=SETTINGS.start_cycles + longer,
        )

    @property
    def way_error_m(self) -> float:
        """The bound of a ranging's way: bias, and noise, which is cut at four deviations."""
        return self.multipath_m + 4 * self.way_sigma_m

    @property
    def speed_error_m_s(self) -> float:
        """The bound of a speed: noise, and that a mean over two seconds lags by one."""
        return self.gain_m_s2 + 4 * self.speed_sigma_m_s

    @property
    def way_spread_m(self) -> float:
        """The width of a ranging's error, or of a train's own range: as much to either side."""
        return 2 * max(self.way_error_m, self.own_way_error_m)

    @property
    def speed_spread_m_s(self) -> float:
        """The width of a speed's error: noise to either side, and that its mean lags, gaining or braking."""
        noise_m_s = max(8 * self.speed_sigma_m_s, 2 * self.own_speed_error_m_s)
        return noise_m_s + self.gain_m_s2 + self.brakes_m_s2

    def bounds(self, kind: Kind) -> ArrivalBounds:
        """What the kernel holds a kind of train to: the train's identification tells its kind (003, 2.4)."""
        return ArrivalBounds(
            line_um=round(1e6 * self.excess * kind.limit_m_s),
            gain_um=round(1e6 * self.gain_m_s2),
            cycle_ms=SETTINGS.cycle_ms,
            warning_cycles=self.settings.warning_cycles,
            silence_cycles=3,
            way_spread_mm=1 + round(1e3 * self.way_spread_m),
            speed_spread_mm_s=1 + round(1e3 * self.speed_spread_m_s),
        )

    def start_um(self, kind: Kind) -> int:
        """Where the kernel's start point for a kind lies: its cycles at the greatest pace, and that of the strike."""
        return (self.settings.start_cycles + 1) * self.bounds(kind).line_um

    def conventional_um(self, kind: Kind) -> int:
        """Where the old crossing's start point lies: the warning time at the greatest speed of who strikes it."""
        fastest = kind if self.tells_kinds else max((self.express, self.local), key=lambda each: each.limit_m_s)
        return round(1e6 * WARNING_S * fastest.limit_m_s)


HOURS = tuple(range(5, 24))
"""First and last hour of traffic: 19 h."""
CAR_UM = 20_000_000
PEAK = (7, 8)
"""The hours of the morning's densest traffic (practice)."""

STRAIGHT = Trial(
    name="straight, low houses",
    express=Kind(100 / 3.6, 8, stops=False),
    local=Kind(100 / 3.6, 6, stops=True),
    express_share=0.45,
    tells_kinds=False,
    station_m=1_250.0,
    block_m=300.0,
    gain_m_s2=0.95,
    trains=(6, 12, 20, 20, 14, 11, 10, 10, 10, 10, 10, 11, 14, 16, 15, 13, 12, 10, 6),
    dwell_s=(20, 35, 35, 60),
    share=(0.70, 0.95, 0.50, 0.80),
    way_sigma_m=1.0,
    multipath_m=5.0,
    speed_sigma_m_s=0.25,
    loss=0.005,
)
"""Trial 1, Tobu's Isesaki line (003, 3.1).

Line speed 100 km/h and stations some 2.5 km apart, and 20 trains an hour and track at the peak, are public: both
stations lie beyond all start points, as in trial 2.  Trains of 6 and 8 cars gain 3.3 km/h/s at most, 0.92 m/s², and
3 per mille of descent.  One start point for all, as the paper's conventional crossings have.  Which share of the limit
trains run at is ours: the paper says that it falls at the peak.
Ranging by chirps in 2.4 GHz is good to a metre or two in the open (makers' figures); multipath is low here.
"""

CURVED = Trial(
    name="curve, dense buildings",
    express=Kind(85 / 3.6, 6, stops=False),
    local=Kind(65 / 3.6, 5, stops=True),
    express_share=0.25,
    tells_kinds=True,
    station_m=800.0,
    block_m=200.0,
    gain_m_s2=0.95,
    trains=(6, 14, 20, 21, 17, 14, 13, 13, 13, 13, 13, 15, 17, 18, 18, 16, 14, 11, 7),
    dwell_s=(20, 35, 35, 60),
    share=(0.75, 0.95, 0.55, 0.85),
    way_sigma_m=2.0,
    multipath_m=15.0,
    speed_sigma_m_s=0.5,
    loss=0.03,
)
"""Trial 2, Tokyu's Oimachi line (003, 3.1).

Line speed 85 km/h then, 5 and 6 cars, 20 trains an hour at the peak are public; between stations that near a local does
not exceed 65 km/h.  The old crossing tells kinds apart: a start point for each (3.1).  Stations lie beyond both start
points, since with a stop between them and the road no crossing has a mean of 50.3 s.
Dense buildings: the bias of multipath and the share of lost rangings are larger (ours).
"""

TRIALS = (STRAIGHT, CURVED)


def lawful() -> bool:
    """Tell whether the settings pass the kernel's own checks, with what each kind of train is held to (X5).

    And whether a train's computer can keep what it promises here (X2).
    """
    keeps = OWN_SPEED_M_S + gained_um_s(BRAKE) / 1e6 <= CEILING_OVER_M_S
    points = start_point.are_lawful(START_POINT) and end_point.are_lawful(END_POINT)
    return keeps and points and all(is_lawful(trial) for trial in TRIALS)


def is_lawful(trial: Trial) -> bool:
    """Tell whether one trial's are."""
    return are_lawful(trial.settings) and all(
        have_one_warning_time(trial.bounds(kind), trial.settings) and not refusal(CHANNEL, trial.bounds(kind))
        for kind in (trial.express, trial.local)
    )


def refusal(channel: ChannelSettings, bounds: ArrivalBounds) -> str:
    """Say in one line why a channel is not put into service for a crossing; nothing if it is (X1)."""
    if are_in_time(channel, bounds):
        return ""
    if channel.tick_ms <= 0 or channel.slot_ms <= 0:
        return f"tick {channel.tick_ms} ms, slot {channel.slot_ms} ms: both must be longer than 0 ms"
    return (
        f"{channel.most_pairs} pairs in slots of {channel.slot_ms} ms: rangings up to"
        f" {longest_apart_ms(channel, bounds)} ms old, but they count for"
        f" {bounds.silence_cycles * bounds.cycle_ms} ms: write fewer pairs or shorter slots"
    )
