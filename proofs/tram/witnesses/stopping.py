"""A tram along a street with GPS that errs: it stands, is held there, passes, creeps, and is lost (G2)."""

from __future__ import annotations

from dataclasses import replace

from kernel.tram import display as cab
from kernel.tram.stopping import SLOW_MM_S, Fix, StopLimits, Stopping, begun
from models.tram.stopping import Ride, Street, fell, is_put_back
from proofs.onboard.witnesses.play import Play
from proofs.tram.stopping import THEORY

SITE = Street(StopLimits(near_mm=20_000, held_mm=50_000), first_mm=0, error_mm=15_000, speed_error_mm_s=100)
STOPS_MM = tuple(range(0, 4_000_001, 400_000))


class Along(Play[Street, Ride]):
    """A tram on a street with a stop each 400 m; it begins at the first."""

    def __init__(self, at_mm: int = 0) -> None:
        """Begin."""
        first = Ride(
            at_mm, 0, 0, STOPS_MM[1], False, begun(0), False, at_mm, 0, at_mm, False, False, 0, True, True, at_mm, False
        )
        super().__init__(THEORY, SITE, first)

    def restart(self, here: int, at_mm: int | None = None, *, is_astray: bool = False) -> None:
        """The unit starts anew, with a stop of the way that its driver sets; along that it is at another place."""
        at_mm = self.system.at_mm if at_mm is None else at_mm
        event = {"at_mm": at_mm, "is_astray": is_astray, "here": here}
        self.step("restart", **event, here_mm=STOPS_MM[here], next_mm=STOPS_MM[here + 1])
        assert self.system.stopping == begun(here) == Stopping(here, False, False, False, 0, 0, False)
        assert (self.system.here, self.system.here_mm, self.system.next_mm) == (here, *STOPS_MM[here : here + 2])
        assert (self.system.at_mm, self.system.is_astray, self.system.has_place) == (at_mm, is_astray, False)

    def run(self, to_mm: int) -> None:
        """Run on to a place."""
        self.step("run_on", way_mm=to_mm - self.system.at_mm)
        assert self.system.at_mm == to_mm

    def fix(
        self, off_mm: int = 0, speed_mm_s: int = 0, *, is_placed: bool = True, has_speed: bool = True, wrong: int = 0
    ) -> tuple[int, bool, bool]:
        """Take a fix that is off by so much, its speed by ``wrong``; what the unit tells then: stop, left, stands."""
        before = self.system
        fix = Fix(is_placed, before.at_mm + off_mm, has_speed, speed_mm_s + wrong)
        self.step(
            "take_fix",
            fix=fix,
            speed_mm_s=speed_mm_s,
            here_mm=before.here_mm,
            next_mm=before.next_mm,
            further_mm=STOPS_MM[1] if is_put_back(SITE, before, fix) else before.next_mm + 400_000,
        )
        now = self.system
        assert now.has_place == now.stopping.is_followed == is_placed
        assert (now.fixed_at_mm, now.speed_mm_s) == (before.at_mm, speed_mm_s)
        assert now.here_mm == STOPS_MM[now.stopping.stop]
        assert now.next_mm == now.here_mm + 400_000
        return now.stopping.stop, now.stopping.left, now.stopping.stands


def a_tram_stands_at_its_stop() -> None:
    """Below 5 km/h and near it; GPS jitters, and nothing moves (3.1.2; G2)."""
    along = Along()
    assert along.fix() == (0, False, True)
    along.run(395_000)
    assert along.fix(speed_mm_s=SLOW_MM_S) == (0, True, False)
    assert along.fix(speed_mm_s=SLOW_MM_S - 1) == (1, False, True)
    assert along.system.stood_at_mm == 395_000
    for off_mm in (-15_000, 15_000, 0):
        assert along.fix(off_mm) == (1, False, True)
    assert not along.system.wandered


def near_is_so_near_and_held_is_farther() -> None:
    """It begins to stand within 20 m by GPS, and goes on within 50 m (G2)."""
    along = Along()
    along.run(379_999)
    assert along.fix() == (0, False, False)
    assert along.fix(1) == (1, False, True)
    assert along.fix(-15_000) == (1, False, True)
    along.run(450_000)
    assert along.fix() == (1, False, True)
    assert along.fix(1) == (1, False, False)
    assert along.fix() == (1, False, False)
    assert along.system.stood_at_mm == 380_000 - 1


def it_stands_where_it_begins() -> None:
    """At the stop that was reached last, before it has left it (G2)."""
    along = Along()
    assert along.fix() == (0, False, True)
    assert along.fix(speed_mm_s=3_000) == (0, False, False)
    assert along.fix() == (0, False, True)
    along.run(30_001)
    assert along.fix(-1, speed_mm_s=3_000) == (0, False, False)
    assert along.fix(speed_mm_s=3_000) == (0, True, False)
    assert along.fix(-15_000) == (0, True, False)
    assert along.fix(-15_000, speed_mm_s=3_000) == (0, True, False)


def a_stop_is_passed() -> None:
    """Nobody gets on: it is reached and left at once, once surely behind (G2, G5)."""
    along = Along()
    assert along.fix() == (0, False, True)
    along.run(420_000)
    assert along.fix(speed_mm_s=8_000) == (0, True, False)
    assert along.fix(1, speed_mm_s=8_000) == (1, True, False)
    assert along.fix(speed_mm_s=8_000) == (1, True, False)
    along.run(421_000)
    assert along.fix() == (1, True, False)
    along.run(800_000)
    assert along.fix() == (2, False, True)
    along.run(1_221_000)
    assert along.fix(speed_mm_s=8_000) == (3, True, False)


def at_a_signal_it_does_not_stand() -> None:
    """Between stops it is slow, and stands nowhere (G2)."""
    along = Along()
    assert along.fix() == (0, False, True)
    along.run(200_000)
    assert along.fix(speed_mm_s=8_000) == (0, True, False)
    assert along.fix() == (0, True, False)


def what_is_lost_is_not_made_up() -> None:
    """Without a place, or without a speed, it does not count as standing, and has reached what it had (G2, G6)."""
    along = Along()
    along.run(400_000)
    assert along.fix() == (1, False, True)
    assert along.fix(10**6, is_placed=False) == (1, False, False)
    assert along.fix() == (1, False, True)
    assert along.fix(has_speed=False, wrong=9_000) == (1, False, False)
    along.run(800_000)
    assert along.fix(is_placed=False, speed_mm_s=8_000) == (1, False, False)
    assert along.fix(has_speed=False) == (1, False, False)
    assert not along.system.wandered


def a_unit_that_starts_anew_finds_its_stop_by_its_fixes() -> None:
    """At the third stop it begins with the first, and takes itself to stand nowhere until it has found it (G2, G6)."""
    along = Along()
    assert along.fix() == (0, False, True)
    along.run(800_000)
    assert along.fix(speed_mm_s=8_000) == (1, True, False)
    assert along.fix() == (2, False, True)
    along.restart(0)
    assert along.fix() == (0, False, False)
    along.run(900_000)
    assert along.fix(speed_mm_s=8_000) == (1, False, False)
    assert along.fix(speed_mm_s=8_000) == (2, True, False)
    assert along.fix(speed_mm_s=8_000) == (2, True, False)
    along.restart(2)
    assert along.fix(speed_mm_s=8_000) == (2, False, False)
    before = along.system
    event = {"is_astray": False, "here": 3, "here_mm": 1_200_000, "next_mm": 1_600_000}
    assert along.step("restart", **event, at_mm=before.at_mm) == before
    along.run(1_200_000 - 20_000 - 15_001)
    before = along.system
    assert along.step("restart", **event, at_mm=before.at_mm) == before
    along.run(1_200_000 - 20_000 - 15_000)
    along.restart(3)


def after_a_start_a_stop_is_left_once_it_was_run_over() -> None:
    """Seen at a stop, or before it, and then beyond, by more than GPS errs to one side and the other (G2, G5)."""
    for least_mm, at_mm, has_run in (
        (820_000, 850_000, False),
        (820_000, 850_001, True),
        (820_001, 900_000, False),
        (785_000, 820_000, False),
        (785_000, 820_001, True),
    ):
        along = Along(least_mm)
        along.restart(2)
        assert along.fix(speed_mm_s=8_000) == (2, False, False)
        along.run(at_mm)
        assert along.fix(speed_mm_s=8_000) == (2, has_run, False)
        assert along.system.stopping.has_run == has_run
        along.run(1_221_000)
        assert along.fix(speed_mm_s=8_000) == (3, True, False)
    along = Along(830_000)
    along.restart(2)
    assert along.fix(speed_mm_s=8_000) == (2, False, False)
    assert along.fix(-15_000, speed_mm_s=8_000) == (2, False, False)
    along.run(846_000)
    assert along.fix(speed_mm_s=8_000) == (2, True, False)


def where_the_place_was_lost_a_stop_is_run_over_anew() -> None:
    """What was left stays so; that a next one was left is told once it was run over where there is a place (G2, G5)."""
    along = Along()
    along.fix()
    along.run(60_000)
    assert along.fix(speed_mm_s=8_000) == (0, True, False)
    assert along.fix(speed_mm_s=8_000, is_placed=False) == (0, True, False)
    assert not along.system.stopping.has_run
    along.run(421_000)
    assert along.fix(speed_mm_s=8_000) == (1, False, False)
    along.run(821_000)
    assert along.fix(speed_mm_s=8_000) == (2, True, False)


def who_turns_off_leaves_no_more_of_the_way() -> None:
    """It tells on what it had left; without a place, beside another stop, that is over, and nothing more is left."""
    along = Along()
    along.fix()
    along.run(60_000)
    assert along.fix(speed_mm_s=8_000) == (0, True, False)
    along.step("turn_off")
    assert (along.system.is_astray, along.system.turned_mm) == (True, 60_000)
    before = along.system
    assert along.step("turn_off") == before
    assert along.fix(speed_mm_s=8_000) == (0, True, False)
    assert along.fix(is_placed=False) == (0, True, False)
    assert (along.system.was_lost, along.system.has_begun) == (True, False)
    along.step("come_round", at_mm=430_000)
    assert along.fix(speed_mm_s=8_000) == (1, False, False)
    assert along.system.has_begun
    along.fix(is_placed=False)
    along.step("come_round", at_mm=830_000)
    assert along.fix(speed_mm_s=8_000) == (2, False, False)


def off_the_way(left_at_mm: int = 860_000) -> Along:
    """A tram that has left its third stop, by a fix without an error, and turns off there."""
    along = Along(790_000)
    along.restart(2)
    assert along.fix(speed_mm_s=8_000) == (2, False, False)
    along.run(left_at_mm)
    assert along.fix(speed_mm_s=8_000) == (2, True, False)
    along.step("turn_off")
    assert along.system.farthest_mm == along.system.stopping.most_mm == left_at_mm
    return along


def who_changes_ends_beyond_its_stop_begins_anew() -> None:
    """On a tail track, and back beside the way that is set: 30 m from where it was farthest, however slowly (G2).

    It is beyond the stop that it has left, and tells of none there any more, until it is on a way again.
    """
    for off_mm in (0, 15_000, -15_000):
        along = off_the_way()
        along.run(850_000)
        assert along.fix() == (2, True, False)
        assert along.system.farthest_mm == 860_000
        along.run(830_000 - off_mm)
        assert along.fix(off_mm) == (2, True, False)
        along.run(829_999 - off_mm)
        assert along.fix(off_mm) == (0, False, False)
        assert along.system.stopping.most_mm == along.system.stopping.least_mm == 829_999
        assert (along.system.here_mm, along.system.next_mm) == (0, 400_000)
        assert along.system.farthest_mm == along.system.at_mm == 829_999 - off_mm
        assert (along.system.was_lost, along.system.has_begun, along.system.fell_back) == (True, True, False)
        assert along.fix(speed_mm_s=8_000) == (1, False, False)
        along.run(600_000)
        assert along.fix(speed_mm_s=8_000) == (1, False, False)


def who_was_lost_on_the_tail_track_begins_anew() -> None:
    """It has no place where it changes ends: what counts is where it was seen before (G2)."""
    along = off_the_way()
    along.fix(is_placed=False)
    assert along.system.stopping.most_mm == 860_000
    along.step("come_round", at_mm=830_000)
    assert along.fix(speed_mm_s=8_000) == (2, True, False)
    along.run(829_999)
    assert along.fix(speed_mm_s=8_000) == (0, False, False)


def errors_of_gps_begin_nothing_anew() -> None:
    """On the way a place falls by two errors at most, one ahead and one behind; neither lasts (002, 3.1.2; G2)."""
    along = Along()
    for at_mm, off_mm, told in (
        (0, 0, (0, False, False)),
        (60_000, 15_000, (0, True, False)),
        (60_000, -15_000, (0, True, False)),
        (460_000, 15_000, (1, True, False)),
        (460_000, -15_000, (1, True, False)),
        (460_000, 0, (1, True, False)),
        (470_000, -15_000, (1, True, False)),
    ):
        along.run(at_mm)
        assert along.fix(off_mm, speed_mm_s=8_000) == told
        assert along.system.farthest_mm == at_mm
    assert along.system.stopping.most_mm == 475_000
    assert along.fix(is_placed=False) == (1, True, False)
    assert along.fix(-15_000, speed_mm_s=8_000) == (1, True, False)
    assert not along.system.fell_back


def who_has_come_back_onto_the_way_goes_on_from_there() -> None:
    """Where it was seen beside the way counts no more once it has left a stop on it (G2)."""
    along = Along()
    along.restart(1, 700_000, is_astray=True)
    assert along.fix(15_000, speed_mm_s=8_000) == (1, False, False)
    along.run(400_000)
    assert along.fix(speed_mm_s=8_000) == (1, False, False)
    along.step("turn_onto")
    along.run(460_000)
    assert along.fix(speed_mm_s=8_000) == (1, True, False)
    assert (along.system.stopping.most_mm, along.system.farthest_mm) == (460_000, 460_000)
    assert along.fix(-15_000, speed_mm_s=8_000) == (1, True, False)


def who_begins_anew_is_shown_no_recovery() -> None:
    """The stop is another one; but for who had left the first of the way, which it tells of anew (G5, G6).

    That one is shown it until it stands near a stop, or has no place, or comes to another stop.
    """
    along = off_the_way()
    shown = cab.Display(0, True, 2, False, False, True, 0)
    along.run(829_999)
    stop, _left, stands = along.fix(speed_mm_s=8_000)
    assert not cab.located(shown, True, stop, stands).recovers
    along = Along()
    for at_mm in (0, 60_000):
        along.run(at_mm)
        along.fix(speed_mm_s=8_000)
    assert along.system.stopping.left
    along.step("turn_off")
    along.run(29_999)
    stop, left, stands = along.fix(speed_mm_s=8_000)
    assert (stop, left, stands) == (0, False, False)
    shown = cab.located(cab.Display(0, True, 0, False, False, True, 0), True, stop, stands)
    assert shown.recovers
    along.run(20_000)
    stop, _left, stands = along.fix()
    assert not cab.located(shown, True, stop, stands).recovers


def who_comes_back_begins_by_its_fixes() -> None:
    """A tram turned off and comes back where the way begins; its unit tells of the run before until it has a place."""
    along = Along()
    for to_mm in (0, 460_000):
        along.run(to_mm)
        along.fix(speed_mm_s=8_000)
    assert along.fix(speed_mm_s=8_000) == (1, True, False)
    along.step("turn_off")
    along.fix(is_placed=False)
    along.step("come_round", at_mm=-35_001)
    before = along.system
    assert along.step("turn_onto") == before
    along.step("come_round", at_mm=-35_000)
    unset = along.step("turn_onto")
    assert (unset.is_astray, unset.is_unset) == (False, True)
    assert along.fix(is_placed=False) == (1, True, False)
    assert along.system.is_unset
    assert along.fix() == (0, False, False)
    assert (along.system.is_unset, along.system.fell_back) == (False, False)


def who_runs_over_no_stop_leaves_none() -> None:
    """It set back to its stop, and its unit was set to the other way: that has risen, and not beyond a stop (G2)."""
    along = Along(750_000)
    along.restart(1)
    assert along.fix(speed_mm_s=8_000) == (1, False, False)
    along.run(820_000)
    assert along.fix(speed_mm_s=8_000) == (1, False, False)
    assert not along.system.stopping.has_run


def a_tram_set_to_another_way_leaves_no_stop_there() -> None:
    """It runs over the line the other way, stands, is lost, comes round: it tells where it is, and nothing left (G3).

    A stop that it was said to have reached, and is seen before, it has not reached: its unit begins anew.
    """
    along = Along()
    along.restart(0, 1_300_000, is_astray=True)
    for stop in (1, 2, 3, 3):
        assert along.fix(15_000, speed_mm_s=8_000) == (stop, False, False)
    along.run(1_200_000)
    assert along.fix() == (3, False, True)
    along.run(1_165_000)
    assert along.fix(-15_000, speed_mm_s=8_000) == (3, False, False)
    assert along.fix(-15_001 + 15_000, speed_mm_s=8_000) == (3, False, False)
    along.run(1_164_999)
    assert along.fix(-15_000, speed_mm_s=8_000) == (0, False, False)
    assert (along.system.here_mm, along.system.stopping.least_mm) == (0, 1_149_999)
    assert not along.system.fell_back
    for off_mm, stop in ((15_000, 1), (15_000, 2), (-15_000, 2)):
        assert along.fix(off_mm, speed_mm_s=8_000) == (stop, False, False)
    before = along.system
    assert along.step("come_round", at_mm=3_000_000) == before
    along.fix(is_placed=False)
    along.step("come_round", at_mm=3_000_000)
    assert (along.system.at_mm, along.system.is_astray) == (3_000_000, True)
    for stop in (3, 4, 5):
        assert along.fix(speed_mm_s=8_000) == (stop, False, False)
    along.restart(3, 0, is_astray=True)
    assert along.fix() == (0, False, False)


def what_is_set_before_a_tram_turns_is_right_when_it_has_turned() -> None:
    """A driver sets the way back two stops too soon; where that begins nothing is told of these stops (G2, G5)."""
    along = Along()
    along.restart(0, 900_000, is_astray=True)
    for stop in (1, 2):
        assert along.fix(speed_mm_s=8_000) == (stop, False, False)
    along.run(0)
    before = along.system
    assert along.step("turn_onto") == before
    assert along.fix() == (0, False, False)
    along.step("turn_onto")
    assert not along.system.is_astray
    assert along.fix() == (0, False, True)
    along.run(30_001)
    assert along.fix(speed_mm_s=8_000) == (0, True, False)
    before = along.system
    assert along.step("come_round", at_mm=0) == before
    along.fix(is_placed=False)
    before = along.system
    assert along.step("come_round", at_mm=0) == before


def what_nature_does_not_do() -> None:
    """Run back, or along another way; err by more than is written, or move the stops (G1, G2)."""
    along = Along()
    along.restart(0, 900_000, is_astray=True)
    before = along.system
    assert along.step("run_on", way_mm=1) == before
    along = Along()
    before = along.system
    assert along.step("run_on", way_mm=-1) == before
    for fix, speed_mm_s, here_mm, next_mm in (
        (Fix(True, 15_001, True, 0), 0, 0, 400_000),
        (Fix(True, 0, True, 0), 101, 0, 400_000),
        (Fix(True, 0, True, 0), 0, 1, 400_000),
        (Fix(True, 0, True, 0), 0, 0, 400_001),
    ):
        event = {"fix": fix, "speed_mm_s": speed_mm_s, "here_mm": here_mm, "next_mm": next_mm, "further_mm": 800_000}
        assert along.step("take_fix", **event) == before


def limits_that_places_may_undo_are_refused() -> None:
    """Near is nearer than places err, or a place is held for less than they err to both sides: no fix is taken (G2)."""
    for near_mm, held_mm, error_mm, is_taken in (
        (15_000, 45_000, 15_000, True),
        (14_999, 45_000, 15_000, False),
        (15_000, 44_999, 15_000, False),
        (0, 0, 0, True),
        (20_000, 50_000, -1, False),
    ):
        along = Along()
        along.run(1)
        along.site = Street(StopLimits(near_mm, held_mm), 0, error_mm, 100)
        event = {"fix": Fix(False, 0, False, 0), "speed_mm_s": 0, "here_mm": 0, "next_mm": 400_000}
        taken = along.step("take_fix", further_mm=800_000, **event)
        assert taken.fixed_at_mm == (1 if is_taken else 0)


def what_tells_less_of_the_way_has_fallen_back() -> None:
    """An earlier stop, or one that was left and is not any more; a later stop not yet left has not (G2)."""
    left, at_it = replace(begun(3), left=True, has_run=True), begun(3)
    assert fell(at_it, begun(2))
    assert fell(at_it, replace(left, stop=2))
    assert fell(left, at_it)
    assert not fell(at_it, left)
    assert not fell(left, begun(4))
    assert not fell(at_it, at_it)


WITNESSES = (
    limits_that_places_may_undo_are_refused,
    what_tells_less_of_the_way_has_fallen_back,
    a_tram_stands_at_its_stop,
    near_is_so_near_and_held_is_farther,
    it_stands_where_it_begins,
    a_stop_is_passed,
    at_a_signal_it_does_not_stand,
    what_is_lost_is_not_made_up,
    a_unit_that_starts_anew_finds_its_stop_by_its_fixes,
    after_a_start_a_stop_is_left_once_it_was_run_over,
    where_the_place_was_lost_a_stop_is_run_over_anew,
    who_turns_off_leaves_no_more_of_the_way,
    who_changes_ends_beyond_its_stop_begins_anew,
    who_was_lost_on_the_tail_track_begins_anew,
    errors_of_gps_begin_nothing_anew,
    who_has_come_back_onto_the_way_goes_on_from_there,
    who_begins_anew_is_shown_no_recovery,
    who_comes_back_begins_by_its_fixes,
    who_runs_over_no_stop_leaves_none,
    a_tram_set_to_another_way_leaves_no_stop_there,
    what_is_set_before_a_tram_turns_is_right_when_it_has_turned,
    what_nature_does_not_do,
)
