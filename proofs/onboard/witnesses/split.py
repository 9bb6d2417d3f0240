"""Runs of a train that stays whole, comes apart, is shaken, or is not heard (P5, P6)."""

from __future__ import annotations

from kernel.onboard import split as machine
from kernel.onboard.split import EMPTY, Acceleration, Readings, SplitLimits
from models.onboard.split import Coupled, Watched
from proofs.onboard.split import THEORY
from proofs.onboard.witnesses.play import Play

LIMITS = SplitLimits(
    threshold_mm_s2=300, shock_mm_s2=3_000, disagreement_mm_s2=100, age_ms=300, gap_ms=500, lost_ms=3_000
)
SITE = Coupled(limits=LIMITS, head_error_mm_s2=50, tail_error_mm_s2=50, clock_error_ms=1)
JUST_MADE_UP = Watched(
    now_ms=0,
    state=machine.made_up(LIMITS),
    truths_mm_s2=EMPTY,
    noted_ms=EMPTY,
    measured_ms=0,
    found=False,
    shocked=False,
    due=False,
    disagreed=False,
    unheard_ms=0,
)
NOTHING = Readings(Acceleration(0, True), False, Acceleration(0, False), Acceleration(0, False), 0)


class Train(Play[Coupled, Watched]):
    """A train just made up, and what it is told in each cycle."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, JUST_MADE_UP)

    def cycle(
        self,
        head: int = 0,
        tail: int = 0,
        *,
        left: int | None = None,
        right: int | None = None,
        head_valid: bool = True,
        left_valid: bool = True,
        right_valid: bool = True,
        age_ms: int = 100,
    ) -> None:
        """A cycle with a telegram; head and tail are the truth, and what sensors show if not told otherwise."""
        before = self.system.now_ms
        readings = Readings(
            Acceleration(head, head_valid),
            True,
            Acceleration(tail if left is None else left, left_valid),
            Acceleration(tail if right is None else right, right_valid),
            age_ms,
        )
        self.step(
            "run_a_cycle",
            head_mm_s2=head,
            tail_mm_s2=tail,
            measured_ms=before + 100 - age_ms,
            readings=readings,
        )
        assert self.system.now_ms == before + 100

    def silence(self, cycles: int = 1) -> None:
        """Cycles without a telegram."""
        for _ in range(cycles):
            self.step("run_a_cycle", head_mm_s2=0, tail_mm_s2=0, measured_ms=0, readings=NOTHING)

    def heard(self, cycles: int = 15) -> None:
        """Cycles of a whole train that accelerates, each with its telegram."""
        for _ in range(cycles):
            self.cycle(700, 700)

    def intact(self) -> bool:
        """Whether the machine takes the train for whole."""
        return machine.is_intact(LIMITS, self.system.state)

    def brakes(self) -> bool:
        """Whether the machine demands the emergency brake."""
        return machine.demands_emergency_brake(self.system.state)


def a_whole_train_is_intact_after_a_window() -> None:
    """15 telegrams in a row, at full acceleration, at both edges of the age: intact, no brake (P5)."""
    train = Train()
    assert not train.intact()
    train.heard(13)
    train.cycle(700, 700, age_ms=LIMITS.age_ms)
    assert not train.intact()
    train.cycle(700, 700, age_ms=0)
    assert train.intact()
    assert not train.brakes()
    assert not train.system.due


def a_difference_at_the_threshold_is_no_split() -> None:
    """The mean may reach the threshold, for ever; sensors at the edge of agreement count (P5, P6)."""
    for sign in (1, -1):
        train = Train()
        for _ in range(40):
            train.cycle(sign * 300, 0, left=-50, right=50)
        assert train.intact()
        assert not train.brakes()


def a_lasting_difference_is_found_in_a_window() -> None:
    """A tail that stays behind, or runs up, is found within 15 telegrams, and the train stops (P5)."""
    for sign in (1, -1):
        train = Train()
        train.heard()
        for _ in range(15):
            assert not train.brakes()
            train.cycle(sign * 301, 0)
        assert train.brakes()
        assert not train.intact()


def a_split_stays_found_until_the_train_is_made_up() -> None:
    """Alike again, even for long, is no proof; a supervised making up is (P5)."""
    train = Train()
    for _ in range(15):
        train.cycle(1_000, -1_000)
    train.heard(40)
    assert train.brakes()
    assert not train.intact()
    assert train.system.found
    train.cycle(left=101)
    assert train.system.disagreed
    anew = train.step("make_up")
    assert not train.brakes()
    assert not train.intact()
    assert (anew.found, anew.due, anew.disagreed) == (False, False, False)
    train.heard()
    assert train.intact()


def a_restart_does_not_forget_a_split() -> None:
    """What a unit cannot know it takes for the worst (P5, T8)."""
    train = Train()
    train.heard()
    train.step("restart")
    assert train.brakes()
    train.heard(40)
    assert train.brakes()
    assert not train.intact()


def a_shock_is_found_at_once() -> None:
    """Of either sensor, either way, however late; or one great difference (P5)."""
    for shaken in (3_001, -3_001):
        for late_ms in (100, 10_000, -100):
            train = Train()
            train.heard()
            train.cycle(0, shaken, right_valid=False, age_ms=late_ms)
            assert train.brakes()
            train = Train()
            train.heard()
            train.cycle(0, shaken, left_valid=False, age_ms=late_ms)
            assert train.brakes()
    for sign in (1, -1):
        train = Train()
        train.heard()
        train.cycle(sign * 1_501, -sign * 1_500)
        assert train.brakes()


def no_shock_at_the_limit_and_none_of_an_invalid_sensor() -> None:
    """At the limit nothing is found; nor from a sensor that says that it has no reading, or no telegram (P5)."""
    train = Train()
    train.heard()
    train.cycle(2_500, 3_000)
    train.cycle(-2_500, -3_000)
    train.cycle(1_500, -1_500)
    train.cycle(-1_500, 1_500)
    train.cycle(left=9_000, left_valid=False)
    train.cycle(right=9_000, right_valid=False)
    left_over = Readings(Acceleration(0, True), False, Acceleration(9_000, True), Acceleration(9_000, True), 0)
    train.step("run_a_cycle", head_mm_s2=0, tail_mm_s2=0, measured_ms=0, readings=left_over)
    assert not train.brakes()
    assert train.system.unheard_ms == 300


def a_doubtful_telegram_is_not_intact_until_a_good_one() -> None:
    """Disagreeing, invalid, out of range, too old, from the future: not intact, through silence, and no split (P6)."""
    doubtful: tuple[dict[str, int | bool], ...] = (
        {"left": 101},
        {"right": 101},
        {"left_valid": False},
        {"right_valid": False},
        {"head_valid": False},
        {"age_ms": 301},
        {"age_ms": -1},
    )
    for what in doubtful:
        train = Train()
        train.heard()
        assert train.intact()
        train.cycle(**what)  # type: ignore[arg-type]
        assert not train.intact()
        assert train.system.disagreed == ("left" in what or "right" in what)
        train.silence()
        assert not train.intact()
        assert not train.brakes()
        train.cycle()
        assert train.intact()


def a_head_beyond_the_range_is_no_reading() -> None:
    """What no train does is not compared (P5)."""
    for wild in (100_001, -100_001):
        train = Train()
        train.heard()
        train.cycle(wild, 0)
        assert not train.intact()
        assert not train.brakes()
        assert train.system.state.differences_mm_s2 == EMPTY
    for most in (100_000, -100_000):
        train = Train()
        train.cycle(most, 0)
        assert train.system.state.differences_mm_s2[0] == 2 * most


def a_short_gap_is_tolerated_and_a_longer_one_is_not() -> None:
    """Five missing telegrams in 15 are; the sixth is too many, one by one too, until 15 come in a row (P5)."""
    train = Train()
    train.heard()
    train.silence(5)
    assert train.intact()
    train.heard(14)
    assert train.intact()
    train.silence()
    assert not train.intact()
    train.heard(14)
    assert not train.intact()
    train.cycle()
    assert train.intact()
    train.silence(5)
    assert train.intact()


def a_long_silence_is_latched_until_the_train_is_made_up() -> None:
    """After 30 missing telegrams nothing but a making up helps; no brake is asked for (P5)."""
    train = Train()
    train.heard()
    train.silence(30)
    train.heard()
    assert train.intact()
    train.silence(31)
    train.heard(40)
    assert train.system.unheard_ms == 3_100
    assert not train.intact()
    assert not train.brakes()
    train.step("make_up")
    train.heard()
    assert train.intact()


def an_old_value_hides_nothing() -> None:
    """Cycles without a telegram leave the window as it is: the split is found at the same telegram (P5)."""
    train = Train()
    train.heard()
    for _ in range(14):
        train.cycle(301, 0)
        train.silence()
    assert not train.brakes()
    train.cycle(301, 0)
    assert train.brakes()


def true_shocks_go_down_in_history() -> None:
    """Beyond limit and errors, of a sensor with a reading or of a difference that counts, until made up (P5)."""
    for sign in (1, -1):
        for tail, speaks, shaken in ((3_051, True, True), (3_050, True, False), (3_051, False, False)):
            for other in ("left_valid", "right_valid"):
                train = Train()
                valid = {"left_valid": speaks, "right_valid": speaks} | {other: False}
                train.cycle(0, sign * tail, **valid)
                assert train.system.shocked == shaken
        for head, shaken in ((1_576, True), (1_575, False)):
            train = Train()
            train.cycle(sign * head, -sign * 1_575)
            train.cycle()
            assert train.system.shocked == shaken
            train.step("make_up")
            assert not train.system.shocked


def an_alarm_is_due_only_near_a_limit() -> None:
    """Neither a sensor that says that it has no reading, nor one too low, nor what is not compared is a reason (P5)."""
    for one, other in ((True, True), (True, False), (False, True), (False, False)):
        train = Train()
        train.cycle(2_951, 2_951, left_valid=one, right_valid=other)
        assert train.system.due == (one or other)
        assert not train.brakes()
    for value, due in ((2_000, False), (3_000, False), (3_001, True), (-3_001, True)):
        for left, right in ((value, 0), (0, value)):
            train = Train()
            train.cycle(left=left, right=right)
            assert train.system.due == due
            assert train.brakes() == due
    train = Train()
    train.cycle(2_000, -2_000, age_ms=301)
    left_over = Readings(Acceleration(0, True), False, Acceleration(9_000, True), Acceleration(9_000, True), 0)
    train.step("run_a_cycle", head_mm_s2=0, tail_mm_s2=9_000, measured_ms=0, readings=left_over)
    assert not train.system.due


def a_sensor_without_a_reading_may_show_anything() -> None:
    """At the head, or at both sides of the tail; the train is then not intact (P5)."""
    good, wild = Acceleration(0, True), Acceleration(9_000, False)
    for head, tail in ((wild, good), (good, wild)):
        train = Train()
        train.heard()
        readings = Readings(head, True, tail, tail, 0)
        train.step("run_a_cycle", head_mm_s2=0, tail_mm_s2=0, measured_ms=1_600, readings=readings)
        assert train.system.now_ms == 1_600
        assert not train.intact()
        assert not train.brakes()


def what_nature_does_not_do_does_not_happen() -> None:
    """A head beyond its error, two faulty sensors, a clock beyond its error: such events are refused."""
    train = Train()
    good = Acceleration(0, True)
    bad = Acceleration(51, True)
    for head, left, right, age_ms in ((bad, good, good, 0), (good, bad, bad, 0), (good, good, good, -2)):
        before = train.system
        readings = Readings(head, True, left, right, age_ms)
        after = train.step("run_a_cycle", head_mm_s2=0, tail_mm_s2=0, measured_ms=100, readings=readings)
        assert after == before


WITNESSES = (
    a_whole_train_is_intact_after_a_window,
    a_difference_at_the_threshold_is_no_split,
    a_lasting_difference_is_found_in_a_window,
    a_split_stays_found_until_the_train_is_made_up,
    a_restart_does_not_forget_a_split,
    a_shock_is_found_at_once,
    no_shock_at_the_limit_and_none_of_an_invalid_sensor,
    a_doubtful_telegram_is_not_intact_until_a_good_one,
    a_head_beyond_the_range_is_no_reading,
    a_short_gap_is_tolerated_and_a_longer_one_is_not,
    a_long_silence_is_latched_until_the_train_is_made_up,
    an_old_value_hides_nothing,
    true_shocks_go_down_in_history,
    an_alarm_is_due_only_near_a_limit,
    a_sensor_without_a_reading_may_show_anything,
    what_nature_does_not_do_does_not_happen,
)
