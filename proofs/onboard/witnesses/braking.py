"""Approaches to the end of authority, at the worst that motors, descent and brake may do (T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import braking as machine
from kernel.onboard.braking import FARTHEST_MM, Brake, BrakeBounds
from kernel.onboard.ceiling import NONE as NO_CEILING
from kernel.onboard.speed_limit import SpeedTable
from models.onboard import slowing
from models.onboard.braking import Approach, Vehicle
from models.onboard.ceiling import AT_REST
from models.onboard.units import NM_A_MM
from proofs.onboard.braking import THEORY
from proofs.onboard.witnesses import braking_ahead, braking_ceiling, braking_history
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints

BOUNDS = BrakeBounds(
    gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=15, falls_mm_s2=1_200
)
TABLE = SpeedTable(line_mm_s=60_000, curve_mm_s=25_000, turnout_mm_s=12_000)
SITE = Vehicle(BOUNDS, TABLE)
END_MM = 3_000_000


def standing(head_mm: int = 0, end_mm: int = END_MM, bounds: BrakeBounds = BOUNDS) -> Approach:
    """A train of such bounds that stands with its brake on, its head a way before the end."""
    return Approach(
        head_nm=head_mm * NM_A_MM,
        speed_um_s=0,
        response_cycles=0,
        worst_um_s=0,
        reach_nm=head_mm * NM_A_MM,
        left_nm=0,
        demanded=False,
        released_amiss=False,
        brake=Brake(applied=True, end_mm=end_mm, withheld=True),
        wanted=False,
        wanted_mm=0,
        slowing=slowing.at_rest(bounds, head_mm * NM_A_MM, end_mm),
        ceiling=NO_CEILING,
        keeping=AT_REST,
    )


class Train(Play[Vehicle, Approach]):
    """A train at rest, and what it does; its range of places and speeds is a point, if not told otherwise."""

    def __init__(self, system: Approach | None = None) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, standing() if system is None else system)
        head_mm, end_mm = self.system.head_nm // NM_A_MM, self.system.brake.end_mm
        self.step("take_end", front_most_mm=head_mm, speed_least_mm_s=0, speed_most_mm_s=0, end_mm=end_mm)
        assert self.system.brake == Brake(applied=True, end_mm=end_mm)

    def cycle(
        self,
        speed_um_s: int,
        *,
        demanded: bool = False,
        acknowledged: bool = False,
        front_mm: int | None = None,
        speed_mm_s: int | None = None,
        least_mm_s: int | None = None,
    ) -> None:
        """Get to a speed in one cycle, as far as can be: at the higher of the speeds at its ends, for 102 ms."""
        before = self.system
        to_nm = before.head_nm + 102 * max(before.speed_um_s, speed_um_s)
        self.step(
            "run_a_cycle",
            front_most_mm=-(-before.head_nm // NM_A_MM) if front_mm is None else front_mm,
            speed_least_mm_s=before.speed_um_s // 1_000 if least_mm_s is None else least_mm_s,
            speed_most_mm_s=-(-before.speed_um_s // 1_000) if speed_mm_s is None else speed_mm_s,
            demanded=demanded,
            acknowledged=acknowledged,
            to_nm=to_nm,
            speed_um_s=speed_um_s,
        )
        assert (self.system.head_nm, self.system.speed_um_s) == (to_nm, speed_um_s)

    def release(self) -> None:
        """The driver acknowledges at a standstill, and the brake goes off."""
        self.cycle(0, acknowledged=True)
        assert not self.brakes()

    def worst_cycle(self, acknowledged: bool = False) -> None:
        """As fast as it can: gaining until the brake responds, then slowing by what is guaranteed and no more."""
        gained = self.system.speed_um_s + 102 * BOUNDS.gains_mm_s2
        slowed = max(0, self.system.speed_um_s - 98 * BOUNDS.slows_mm_s2)
        waits = min(self.system.response_cycles, self.system.slowing.response_cycles)
        responds = self.brakes() and waits == 0
        self.cycle(slowed if responds else gained, acknowledged=acknowledged)

    def brakes(self) -> bool:
        """Whether the emergency brake is commanded."""
        return self.system.brake.applied


def running(speed_mm_s: int, end_mm: int = END_MM) -> Train:
    """A train that runs at a speed, its brake off."""
    train = Train(standing(end_mm=end_mm))
    train.release()
    while train.system.speed_um_s < 1_000 * speed_mm_s:
        train.cycle(train.system.speed_um_s + 100_000)
    assert not train.brakes()
    return train


def needed_mm(speed_mm_s: int) -> int:
    """The way that the rule keeps before the end, reckoned here anew: 16 long cycles, one to take hold, v²/2b."""
    fast_um_s = 1_000 * speed_mm_s + 16 * 102 * 1_200
    way_nm = 17 * 102 * fast_um_s - (-fast_um_s * fast_um_s // (2 * 672))
    return -(-way_nm // NM_A_MM)


# ---- approaches


def at_its_worst_a_train_stops_a_little_short_of_the_end() -> None:
    """Full power until the brake responds, at 176 km/h, then no more than is guaranteed: 16 m short at most (T12)."""
    train = Train()
    train.release()
    while not train.brakes():
        train.worst_cycle()
    assert train.system.speed_um_s == 48_960_000
    cycles = 0
    while train.system.speed_um_s > 0:
        train.worst_cycle(acknowledged=True)
        assert train.brakes()
        cycles += 1
    assert cycles == 753
    assert END_MM - 16_000 < train.system.head_nm // NM_A_MM < END_MM


def at_a_constant_speed_the_brake_comes_on_in_time() -> None:
    """Where the way that the rule keeps begins, and not a cycle earlier (T12)."""
    for speed_mm_s, way_mm in ((36_000, 1_132_788), (5_000, 47_355), (1_000, 11_451)):
        train = running(speed_mm_s)
        at_mm = 0
        while not train.brakes():
            at_mm = train.system.head_nm // NM_A_MM
            train.cycle(1_000 * speed_mm_s)
        assert END_MM - train.system.head_nm // NM_A_MM == way_mm
        assert END_MM - at_mm < needed_mm(speed_mm_s) <= END_MM - at_mm + 102 * speed_mm_s // 1000 + 1


def to_the_millimetre_the_way_is_enough_or_not() -> None:
    """At any speed, from a standstill to 200 m/s (T12)."""
    for speed_mm_s in (0, 1, 1_000, 36_111, 200_000):
        for front_mm in (0, -5_000_000, 7_000_000):
            end_mm = front_mm + needed_mm(speed_mm_s)
            assert machine.stops_before(BOUNDS, front_mm, speed_mm_s, end_mm)
            assert not machine.stops_before(BOUNDS, front_mm, speed_mm_s, end_mm - 1)


def with_room_ahead_the_brake_stays_off() -> None:
    """For a minute at 130 km/h, with or without a driver who acknowledges (T12)."""
    train = running(36_100, end_mm=20_000_000)
    for cycle in range(600):
        train.cycle(36_100_000, acknowledged=cycle % 2 == 0)
        assert not train.brakes()


def the_range_counts_and_not_the_point() -> None:
    """As far and as fast as the train may be: an uncertain train brakes earlier (T12, P7)."""
    train = running(36_000)
    here_mm = train.system.head_nm // NM_A_MM
    room_mm = END_MM - needed_mm(36_000)
    train.cycle(36_000_000, front_mm=room_mm)
    assert not train.brakes()
    train.cycle(36_000_000, front_mm=room_mm + 1)
    assert train.brakes()
    train = running(36_000)
    assert not machine.supervise(BOUNDS, train.system.brake, here_mm, 0, 50_000, False, False).applied
    train.cycle(36_000_000, front_mm=here_mm, speed_mm_s=65_000)
    assert train.brakes()


# ---- on and off


def a_demand_of_another_machine_is_obeyed_at_once() -> None:
    """Open loop, split, lost position: the brake is on in the same cycle, room or not (T5, P5)."""
    train = running(10_000)
    train.cycle(10_000_000, demanded=True)
    assert train.brakes()
    train.cycle(10_000_000)
    assert train.brakes()


def a_train_of_unknown_range_is_braked_until_it_is_located() -> None:
    """Whatever numbers are left of its range, and however often the driver acknowledges (P7, T12)."""
    train = running(10_000)
    while train.system.speed_um_s > 0 or not train.brakes():
        responds = train.brakes() and train.system.response_cycles == 0
        train.cycle(
            max(0, train.system.speed_um_s - 70_000) if responds else 10_000_000,
            demanded=True,
            acknowledged=True,
            front_mm=-5_000_000,
            least_mm_s=0,
            speed_mm_s=0,
        )
        assert train.brakes()
        assert train.system.demanded
    train.release()
    assert not train.system.demanded


def a_train_that_rolls_back_is_not_released() -> None:
    """Its speed is no standstill, although it is below all that is allowed forward (T5, T12)."""
    train = Train()
    train.release()
    for _ in range(5):
        train.cycle(train.system.speed_um_s - 100_000)
    train.cycle(-600_000, demanded=True)
    train.cycle(-600_000, acknowledged=True, speed_mm_s=0)
    assert train.brakes()
    for speed_um_s in range(-500_000, 100_000, 100_000):
        train.cycle(speed_um_s)
    train.release()


def a_train_that_rolls_back_may_be_stopped_within_a_cycle() -> None:
    """By its brakes, from whatever speed; forward it gains no more than from a standstill (T5, T12)."""
    train = Train()
    train.release()
    for speed_um_s in (-300_000, -600_000, 122_400):
        train.cycle(speed_um_s)


def the_brake_stays_on_until_all_is_well() -> None:
    """Standing, acknowledged, nothing demanded and room ahead: all four, in one cycle (T12)."""
    train = running(5_000)
    train.cycle(5_000_000, demanded=True)
    while train.system.speed_um_s > 0:
        train.worst_cycle(acknowledged=True)
        assert train.brakes()
    train.cycle(0)
    assert train.brakes()
    train.cycle(0, acknowledged=True, demanded=True)
    assert train.brakes()
    train.cycle(0, acknowledged=True, speed_mm_s=26)
    assert train.brakes()
    train.cycle(0, acknowledged=True, least_mm_s=-26)
    assert train.brakes()
    train.cycle(0, acknowledged=True, front_mm=END_MM)
    assert train.brakes()
    train.cycle(0, acknowledged=True, least_mm_s=-25, speed_mm_s=25)
    assert not train.brakes()
    assert train.system.response_cycles == 15
    train.cycle(120_000)
    assert not train.brakes()


def released_and_off_in_one_cycle() -> None:
    """A train may start in the cycle in which its brake goes off (T12)."""
    train = Train()
    train.cycle(120_000, acknowledged=True)
    assert not train.brakes()


def a_train_at_its_end_stands() -> None:
    """No acknowledgement lets it start; a brake that has responded holds it (T12)."""
    train = Train(standing(head_mm=END_MM))
    for _ in range(3):
        train.cycle(0, acknowledged=True)
        assert train.brakes()
    before = train.system
    event = {
        "front_most_mm": END_MM,
        "speed_least_mm_s": 0,
        "speed_most_mm_s": 0,
        "demanded": False,
        "acknowledged": True,
    }
    assert train.step("run_a_cycle", **event, to_nm=before.head_nm + 1, speed_um_s=1) == before


# ---- ends


def a_farther_end_is_taken_at_any_time() -> None:
    """Whether or not the train could stop before it, brake on or off; so is the same one (T4, T12)."""
    train = running(36_000)
    while not train.brakes():
        train.cycle(36_000_000)
    here_mm = train.system.head_nm // NM_A_MM
    for end_mm in (END_MM, END_MM + 1, END_MM + 10_000_000):
        train.step("take_end", front_most_mm=here_mm, speed_least_mm_s=0, speed_most_mm_s=36_000, end_mm=end_mm)
        assert train.system.brake == Brake(applied=True, end_mm=end_mm)
    train = Train()
    train.release()
    train.step("take_end", front_most_mm=0, speed_least_mm_s=0, speed_most_mm_s=0, end_mm=END_MM + 5)
    assert train.system.brake == Brake(applied=False, end_mm=END_MM + 5)


def a_nearer_end_is_taken_if_the_train_can_stop() -> None:
    """To the millimetre; the brake stays as it is, and its response is reckoned anew (T9, T12)."""
    train = running(20_000)
    here_mm = train.system.head_nm // NM_A_MM
    end_mm = here_mm + needed_mm(20_000)
    train.step("take_end", front_most_mm=here_mm, speed_least_mm_s=0, speed_most_mm_s=20_000, end_mm=end_mm)
    assert train.system.brake == Brake(applied=False, end_mm=end_mm)
    train.cycle(20_000_000, demanded=True)
    train.worst_cycle()
    assert train.system.response_cycles == 13
    assert train.system.head_nm < 2_100_000 * NM_A_MM
    train = running(20_000)
    train.cycle(20_000_000, demanded=True)
    train.step(
        "take_end", front_most_mm=here_mm + 2_040, speed_least_mm_s=0, speed_most_mm_s=20_000, end_mm=here_mm + 900_000
    )
    assert train.system.brake == Brake(applied=True, end_mm=here_mm + 900_000)
    assert train.system.response_cycles == 15
    while train.system.speed_um_s > 0:
        train.worst_cycle()


def a_nearer_end_that_could_be_overrun_is_not_taken() -> None:
    """The brake comes on, and the old end stands: no authority is taken back from below the wheels (T9, T12)."""
    train = running(20_000)
    here_mm = train.system.head_nm // NM_A_MM
    end_mm = here_mm + needed_mm(20_000) - 1
    for nearer_mm in (end_mm, here_mm, -(10**12)):
        train = running(20_000)
        train.step("take_end", front_most_mm=here_mm, speed_least_mm_s=0, speed_most_mm_s=20_000, end_mm=nearer_mm)
        assert train.system.brake == Brake(applied=True, end_mm=END_MM, withheld=True)
        while train.system.speed_um_s > 0:
            train.worst_cycle(acknowledged=True)
        train.cycle(0, acknowledged=True)
        assert train.brakes()


def at_a_standstill_the_nearer_end_is_taken_and_the_brake_released() -> None:
    """If the train has stopped short of it by as much as the rule keeps for a train that gathers speed (T9, T12)."""
    train = running(20_000)
    here_mm = train.system.head_nm // NM_A_MM
    nearer_mm = here_mm + needed_mm(20_000) - 1
    train.step("take_end", front_most_mm=here_mm, speed_least_mm_s=0, speed_most_mm_s=20_000, end_mm=nearer_mm)
    train.cycle(19_900_000)
    while train.system.speed_um_s > 0:
        train.cycle(max(0, train.system.speed_um_s - 100_000))
    here_mm = -(-train.system.head_nm // NM_A_MM)
    assert needed_mm(0) <= nearer_mm - here_mm
    far_mm = nearer_mm - needed_mm(0) + 1
    train.step("take_end", front_most_mm=far_mm, speed_least_mm_s=0, speed_most_mm_s=0, end_mm=nearer_mm)
    train.cycle(0, acknowledged=True)
    assert train.brakes()
    train.step("take_end", front_most_mm=here_mm, speed_least_mm_s=0, speed_most_mm_s=0, end_mm=nearer_mm)
    assert train.system.brake == Brake(applied=True, end_mm=nearer_mm)


def a_train_without_an_end_stays_braked() -> None:
    """No acknowledgement releases it before an end is taken, and a farther one will do (T4, T12)."""
    train = running(20_000)
    train.step("withhold_end")
    assert not train.system.wanted
    assert train.system.brake == Brake(applied=True, end_mm=END_MM, withheld=True)
    while train.system.speed_um_s > 0:
        train.worst_cycle(acknowledged=True)
    train.cycle(0, acknowledged=True)
    assert train.brakes()
    here_mm = -(-train.system.head_nm // NM_A_MM)
    train.step("take_end", front_most_mm=here_mm, speed_least_mm_s=0, speed_most_mm_s=0, end_mm=END_MM)
    train.release()
    assert machine.stand_still(5) == Brake(applied=True, end_mm=5, withheld=True)


# ---- ranges


def a_speed_out_of_range_brakes() -> None:
    """What is no speed of a train is too fast, however far the end is; the edges are speeds (T12)."""
    for speed_mm_s, taken in ((-1, False), (0, True), (200_000, True), (200_001, False), (2**62, False)):
        assert machine.stops_before(BOUNDS, 0, speed_mm_s, FARTHEST_MM) == taken
        off = Brake(applied=False, end_mm=FARTHEST_MM)
        assert machine.supervise(BOUNDS, off, 0, 0, speed_mm_s, False, True).applied != taken
    train = running(36_000, end_mm=FARTHEST_MM)
    train.cycle(36_000_000, speed_mm_s=200_001)
    assert train.brakes()


def an_end_beyond_the_farthest_counts_as_so_far() -> None:
    """1000 km ahead of the train, wherever it is: the numbers stay within 64 bits (T12)."""
    for front_mm in (0, -3, 10**9):
        nearest = machine.left_nm(BOUNDS, front_mm, 0, front_mm + FARTHEST_MM)
        assert machine.left_nm(BOUNDS, front_mm, 0, front_mm + FARTHEST_MM + 1) == nearest
        assert machine.left_nm(BOUNDS, front_mm, 0, front_mm + FARTHEST_MM - 1) == nearest - NM_A_MM
        assert machine.stops_before(BOUNDS, front_mm, 36_111, 2**62)


def a_front_out_of_range_brakes() -> None:
    """What is no place on the line stops nowhere; the edges are places (T12)."""
    edge_mm = 10**9
    for front_mm, taken in ((edge_mm, True), (edge_mm + 1, False), (-edge_mm, True), (-edge_mm - 1, False)):
        assert machine.stops_before(BOUNDS, front_mm, 36_000, front_mm + 2_000_000) == taken


def a_train_at_rest_may_stand_at_its_very_end() -> None:
    """On the level, where it gains nothing: no way is left, and none is needed (T12)."""
    level = replace(BOUNDS, gains_mm_s2=0)
    assert machine.stops_before(level, END_MM, 0, END_MM)
    assert not machine.stops_before(level, END_MM + 1, 0, END_MM)


def every_number_fits_into_64_bits() -> None:
    """Whatever the end: one behind the train is found so before it is multiplied (T12)."""
    for front_mm, end_mm in ((10**9, -(2**62)), (-(10**9), 2**62), (0, FARTHEST_MM), (2**62, 0), (-(2**62), 0)):
        for speed_mm_s in (0, 200_000, 2**62, -(2**62)):
            told = (Checked(front_mm), Checked(speed_mm_s), Checked(end_mm))
            taken = end_mm > front_mm and front_mm >= -(10**9) and 0 <= speed_mm_s <= 200_000
            assert machine.stops_before(with_ints(Checked, BOUNDS), *told) == taken


# ---- nature


def what_nature_does_not_do_does_not_happen() -> None:
    """A head or a speed outside its range, farther than its speed, more gain, less brake: such events are refused."""
    train = running(20_000)
    before = train.system
    front_mm = before.head_nm // NM_A_MM
    event = {
        "front_most_mm": front_mm,
        "speed_least_mm_s": 20_000,
        "speed_most_mm_s": 20_000,
        "demanded": False,
        "acknowledged": False,
        "to_nm": before.head_nm + 2_040 * NM_A_MM,
        "speed_um_s": 20_000_000,
    }
    refused: tuple[dict[str, int], ...] = (
        {"front_most_mm": front_mm - 1},
        {"speed_least_mm_s": 20_001},
        {"speed_most_mm_s": 19_999},
        {"to_nm": before.head_nm + 2_040 * NM_A_MM + 1},
        {"speed_um_s": 20_122_401},
    )
    for what in refused:
        assert train.step("run_a_cycle", **{**event, **what}) == before
    for told in ({"front_most_mm": front_mm - 1}, {"speed_most_mm_s": 19_999}):
        end = {"front_most_mm": front_mm, "speed_least_mm_s": 20_000, "speed_most_mm_s": 20_000, **told}
        end["end_mm"] = END_MM + 1
        assert train.step("take_end", **end) == before
    train.cycle(20_000_000, demanded=True)
    for _ in range(14):
        train.cycle(20_000_000)
    assert train.system.response_cycles == 0
    held = train.system
    weak = {**event, "front_most_mm": held.head_nm // NM_A_MM, "to_nm": held.head_nm + 2_040 * NM_A_MM}
    assert train.step("run_a_cycle", **{**weak, "speed_um_s": 19_931_401}) == held
    assert train.step("run_a_cycle", **{**weak, "speed_um_s": 19_931_400}).speed_um_s == 19_931_400


WITNESSES = (
    at_its_worst_a_train_stops_a_little_short_of_the_end,
    at_a_constant_speed_the_brake_comes_on_in_time,
    to_the_millimetre_the_way_is_enough_or_not,
    with_room_ahead_the_brake_stays_off,
    the_range_counts_and_not_the_point,
    a_demand_of_another_machine_is_obeyed_at_once,
    a_train_of_unknown_range_is_braked_until_it_is_located,
    a_train_that_rolls_back_is_not_released,
    a_train_that_rolls_back_may_be_stopped_within_a_cycle,
    the_brake_stays_on_until_all_is_well,
    released_and_off_in_one_cycle,
    a_train_at_its_end_stands,
    a_farther_end_is_taken_at_any_time,
    a_nearer_end_is_taken_if_the_train_can_stop,
    a_nearer_end_that_could_be_overrun_is_not_taken,
    at_a_standstill_the_nearer_end_is_taken_and_the_brake_released,
    a_train_without_an_end_stays_braked,
    a_speed_out_of_range_brakes,
    an_end_beyond_the_farthest_counts_as_so_far,
    a_front_out_of_range_brakes,
    a_train_at_rest_may_stand_at_its_very_end,
    every_number_fits_into_64_bits,
    what_nature_does_not_do_does_not_happen,
    *braking_history.WITNESSES,
    *braking_ahead.WITNESSES,
    *braking_ceiling.WITNESSES,
)
