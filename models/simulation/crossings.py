"""Level crossings of a simulated line: the kernel's machine decides each second, from what trains say by radio (X1-X5).

A unit in reach says how near its head may be, by its own range, and how fast, on a link of its own with the crossing;
and that it is not coming any more, once its rear is proved past or it leads away, all of it.  Start points are struck
on every way to the road, and told by the crossing's terminal; staff tell it of a train that begins its run inside,
and its driver waits until the road has been closed for its time.
"""

from __future__ import annotations

from collections.abc import Mapping
from random import Random

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Ranging
from kernel.crossing.crossing import Crossing, CrossingTrack, Due
from kernel.crossing.crossing import Train as Known
from kernel.link import Party
from kernel.names import Train
from models.crossing.sites import EXCESS, SETTINGS
from models.crossing.traffic import PERSON_S
from models.simulation.crossing_state import LONG_AGO_S, REACH_MM, Seen, State, Told
from models.simulation.diary import ROAD, STAFF, Diary
from models.simulation.driver import ACCELERATES_MM_S2, LINE_MM_S
from models.simulation.links import LIMITS, Links
from models.simulation.posted import Must
from models.simulation.road_oracles import NOBODY, judge_opening, judge_train
from models.simulation.roads import Ways
from models.simulation.vehicle import Vehicle
from models.simulation.wording import RANGING, Fields

BOUNDS = ArrivalBounds(
    line_um=round(1_000 * EXCESS * LINE_MM_S),
    gain_um=round(1_000 * EXCESS * ACCELERATES_MM_S2),
    cycle_ms=SETTINGS.cycle_ms,
    warning_cycles=SETTINGS.warning_cycles,
    silence_cycles=5,
    way_spread_mm=100_000,
    speed_spread_mm_s=3_000,
)
"""Some more than trains are driven by; two rangings in a row may be lost."""
START_MM = (SETTINGS.start_cycles + 1) * BOUNDS.line_um // 1_000
"""Start points lie so far before the road: the cycles of the settings at the greatest pace, and that of the strike."""
END_MM = 15_000
"""The rear is past the road here."""
ARMS_S = (8, 10)
"""How long arms take to come down."""


class Crossings:
    """Every level crossing of the line."""

    def __init__(
        self, ways: list[Ways], links: Links, vehicles: Mapping[Train, Vehicle], diary: Diary, must: Must, seed: int
    ) -> None:
        assert machine.are_lawful(SETTINGS), "it is not put into service"
        assert machine.have_one_warning_time(BOUNDS, SETTINGS), "rangings are reckoned as the crossing is set"
        self.links = links
        self.vehicles = vehicles
        self.diary = diary
        self.must = must
        self.random = Random(f"{seed} arms")
        self.states = {each.road.name: self._closed(each) for each in ways}
        self._by_party = {state.party: state for state in self.states.values()}

    def _closed(self, ways: Ways) -> State:
        """A crossing in service, whose track was accounted for: closed, until nobody is on the way."""
        track = CrossingTrack(ways.road.name)
        crossing = Crossing(
            asks={},
            starts={},
            silent_cycles={track: 0},
            unaccounted={track: False},
            numbers={},
            looks={track: 1},
            number=1,
            warns=True,
            warned_cycles=-LONG_AGO_S,
        )
        party = self.links.addresses.road[ways.road.name]
        return State(ways, party, crossing, ARMS_S[1], -LONG_AGO_S, LONG_AGO_S, LONG_AGO_S)

    # ---- a second

    def decide(self, now_s: int) -> None:
        """Trains say where they are, start points are told, and each crossing decides for the second that begins."""
        for state in self.states.values():
            for train, vehicle in self.vehicles.items():
                self._look(state, train, vehicle)
                self._strike(state, train)
                self._says(state, train, vehicle)
                self._release(state, train, vehicle, now_s)
            self._hear(state)
            self._decide(state, now_s)

    def _look(self, state: State, train: Train, vehicle: Vehicle) -> None:
        """See where a train is, in truth."""
        on_rails, before = vehicle.on_rails, state.seen.get(train)
        leads, front_mm = on_rails.cars[0], vehicle.front_mm
        if before is not None and before.leads == leads and before.front_mm == front_mm:
            return
        meets_mm = state.ways.under(on_rails, front_mm)
        stays = before is not None and before.leads == leads
        over_mm = meets_mm if meets_mm is not None or not stays or before is None else before.over_mm
        left = bool(on_rails.standing) and before is not None and before.under
        ahead_mm = state.ways.ahead_mm(on_rails, front_mm)
        state.seen[train] = Seen(leads, front_mm, ahead_mm, over_mm, meets_mm is not None or left)

    def _strike(self, state: State, train: Train) -> None:
        """A train strikes its start point, or is told of by hand where it begins inside (X3)."""
        seen = state.seen[train]
        inside = seen.under or seen.ahead_mm <= START_MM
        if inside and train not in state.struck:
            state.struck.add(train)
            state.strikes.append(train)
        elif not inside and seen.ahead_mm > REACH_MM:
            state.struck.discard(train)

    def _says(self, state: State, train: Train, vehicle: Vehicle) -> None:
        """A unit that knows where it is says how near and how fast its head may be; or that it is not coming."""
        seen, board = state.seen[train], vehicle.board
        if vehicle.restarted or not board.place.known:
            return
        motion = board.motion
        if seen.over_mm is not None and motion.front_least_mm - board.length_mm >= seen.over_mm + END_MM:
            seen.over_mm = None
        is_coming = seen.over_mm is not None or seen.ahead_mm <= REACH_MM
        known = Known(train) in state.crossing.asks
        if not is_coming and (not known or not self._is_whole(vehicle)):
            return
        ahead_mm = seen.ahead_mm - (motion.front_most_mm - vehicle.front_mm)
        way_mm = 0 if seen.over_mm is not None or not is_coming else int(ahead_mm // 1)
        unit = self.links.addresses.unit[train]
        self.links.say(
            unit, state.party, RANGING, at_ms=self.links.clock_ms(unit), way_mm=way_mm,
            speed_mm_s=motion.speed_most_mm_s, is_coming=is_coming,
        )  # fmt: skip

    def _release(self, state: State, train: Train, vehicle: Vehicle, now_s: int) -> None:
        """A person on site looks for a train that is gone and cannot say so, not being sure to be whole (X4).

        One that has parted is not looked for; its road stays closed.
        """
        seen = state.seen[train]
        is_gone = not seen.under and seen.ahead_mm > REACH_MM and not vehicle.on_rails.standing
        if not is_gone or Known(train) not in state.crossing.asks:
            state.attended_s.pop(train, None)
        elif train not in state.attended_s:
            state.attended_s[train] = now_s + self.random.randint(*PERSON_S)
        elif now_s >= state.attended_s[train]:
            number = machine.number_of(state.crossing, Known(train))
            state.crossing = machine.note_released(state.crossing, Known(train), number)
            state.followed.pop(train, None)
            del state.attended_s[train]
            self.diary.note(STAFF, train, f"is released at {state.name} by a person who has seen that it is gone")

    def _is_whole(self, vehicle: Vehicle) -> bool:
        """Whether the train knows that nothing of it was left behind."""
        connected = self.links.air.agenda.now_ms >= vehicle.line_broken_until_ms
        return vehicle.board.intact and connected and not vehicle.on_rails.standing

    # ---- what a crossing hears

    def hears(self, me: Party, peer: Party, fields: Fields) -> None:
        """A crossing's link delivers a unit's word."""
        state, train = self._by_party[me], self.links.addresses.train[peer]
        if not fields["is_coming"]:
            number = machine.number_of(state.crossing, Known(train))
            state.crossing = machine.note_gone(state.crossing, Known(train), number, True)
            state.followed.pop(train, None)
            state.told.pop(train, None)
            return
        state.told[train] = Told(fields["at_ms"], fields["way_mm"], fields["speed_mm_s"])

    def silence_terminal(self, name: str, ms: int) -> None:
        """The terminal of a road's start points is not heard for so long."""
        state = self.states[name]
        until_ms = self.links.air.agenda.now_ms + ms
        state.terminal_silent_until_ms = max(state.terminal_silent_until_ms, until_ms)

    def _hear(self, state: State) -> None:
        """The terminal tells every strike, and that it is there (X3, T14)."""
        if self.links.air.agenda.now_ms < state.terminal_silent_until_ms:
            return
        for train in state.strikes:
            state.crossing = machine.note_struck(state.crossing, Known(train))
        state.strikes = []
        state.crossing = machine.note_heard(state.crossing, state.track, 0)

    def _ranging(self, state: State, train: Train) -> Ranging:
        """What has come of a train since the last decision, made no younger than it may be."""
        told = state.told.pop(train, None)
        if told is None:
            return Ranging(False, 0, 0, 0)
        age_ms = self.links.clock_ms(state.party) - told.at_ms + 2 * LIMITS.offset_ms
        return Ranging(True, told.way_mm, told.speed_mm_s, max(0, -(-age_ms // SETTINGS.cycle_ms)))

    def _decide(self, state: State, now_s: int) -> None:
        """Reckon when each train may arrive, and decide (X2 to X5)."""
        dues: dict[Known, Due] = {}
        for train in sorted({*state.told, *state.followed}):
            ranging = self._ranging(state, train)
            if train in state.followed:
                known = arrival.follow(BOUNDS, state.followed[train], ranging)
            elif arrival.begins_contact(BOUNDS, ranging):
                state.crossing = machine.note_contact(state.crossing, Known(train))
                known = arrival.taken(BOUNDS, arrival.nothing_known(BOUNDS), ranging)
            else:
                continue
            dues[Known(train)] = machine.due(BOUNDS, known, SETTINGS.reopening_cycles)
            state.followed[train] = arrival.aged(BOUNDS, known)
        state.crossing = machine.decide(SETTINGS, state.crossing, dues)
        self._warns(state, now_s)

    def _warns(self, state: State, now_s: int) -> None:
        """Lamps and bells begin or end; arms are let up with them."""
        if state.crossing.warns and state.closed_s is None:
            state.closed_s, state.arms_s = now_s, self.random.randint(*ARMS_S)
            self.diary.note(ROAD, state.name, "is closed")
        elif not state.crossing.warns and state.closed_s is not None:
            if now_s:
                state.closings.append((max(0, state.closed_s), now_s))
            state.closed_s = state.down_s = None
            self.diary.note(ROAD, state.name, "is opened")

    # ---- when trains have run

    def end_second(self, now_s: int) -> None:
        """Arms move, and what trains met at the road is judged: all by the truth."""
        for state in self.states.values():
            for train, vehicle in self.vehicles.items():
                self._judge(state, train, vehicle, now_s)
            state.lowered = state.lowered + 1 if machine.arms_are_to_be_down(SETTINGS, state.crossing) else 0
            if state.lowered >= state.arms_s and state.down_s is None:
                state.down_s = now_s + 1
            state.crossing = machine.aged(state.crossing)
            self._judge_opening(state)

    def _judge(self, state: State, train: Train, vehicle: Vehicle, now_s: int) -> None:
        """See where a train is now, and what it meets there."""
        before = state.seen[train]
        if before.ahead_mm > REACH_MM and not before.under:
            return
        self._look(state, train, vehicle)
        judge_train(self.must, state, train, before, now_s)

    def _judge_opening(self, state: State) -> None:
        """While all is heard a road is closed for somebody, and whoever it knows of may come."""
        silent = self.links.air.agenda.now_ms < state.terminal_silent_until_ms
        away = [train for train in self.vehicles if not self._may_come(state, train)]
        kept_for: list[str] = [train for train in away if Known(train) in state.crossing.asks and not silent]
        if state.crossing.warns and not silent and len(away) == len(self.vehicles):
            kept_for.append(NOBODY)
        judge_opening(self.must, state, kept_for)

    def _may_come(self, state: State, train: Train) -> bool:
        """Whether a train is on its way, or is known and cannot say that it is not."""
        seen, vehicle = state.seen[train], self.vehicles[train]
        if seen.under or seen.over_mm is not None or seen.ahead_mm <= REACH_MM:
            return True
        mute = vehicle.restarted or not vehicle.board.place.known or not self._is_whole(vehicle)
        return mute and Known(train) in state.crossing.asks

    # ---- for drivers

    def lets_depart(self, train: Train) -> bool:
        """Whether a train at rest may begin its run, by every road that is near ahead.

        One that the crossing has been told of waits until it has been closed for its time.  Of one in contact that it
        need not warn of yet the crossing will in time.
        """
        vehicle = self.vehicles[train]
        return all(
            self._lets_depart(state, train)
            for state in self.states.values()
            if state.ways.ahead_mm(vehicle.on_rails, vehicle.front_mm) <= START_MM
        )

    def _lets_depart(self, state: State, train: Train) -> bool:
        asks = state.crossing.asks.get(Known(train))
        return asks is False or (asks is True and state.crossing.warned_cycles >= SETTINGS.warning_cycles)
