"""A train that promises, asks and keeps to it, and a radio that loses, repeats and delays either's word (X2)."""

from __future__ import annotations

from kernel.crossing.promise import Promise, ask, lower, note, note_acknowledged, nothing_promised
from models.crossing.promise import Line, Promising
from proofs.crossing.promise import THEORY
from proofs.onboard.witnesses.play import Play

LINE_MM_S = 30_000
SITE = Line(LINE_MM_S)
NOTHING = nothing_promised(LINE_MM_S)


class Train(Play[Line, Promising]):
    """A train at 20 m/s, and the crossing that it comes to."""

    def __init__(self, speed_mm_s: int = 20_000) -> None:
        """Begin."""
        super().__init__(THEORY, SITE, Promising(speed_mm_s, NOTHING, NOTHING, frozenset(), frozenset()))

    def lower(self, ceiling_mm_s: int) -> Promise:
        """Promise, by a range that is exact; give what is told of it."""
        self.step("lower", ceiling_mm_s=ceiling_mm_s, speed_most_mm_s=self.system.speed_mm_s)
        return self.tell()

    def ask(self, asked_mm_s: int) -> Promise:
        """Ask; give what is told of it."""
        self.step("ask", asked_mm_s=asked_mm_s)
        return self.tell()

    def tell(self) -> Promise:
        """Tell."""
        held = self.system.held
        assert held in self.step("tell").told
        return held

    def hear(self, told: Promise) -> None:
        """The crossing hears it."""
        self.step("hear_promise", told=told)

    def acknowledge(self) -> int:
        """The crossing acknowledges; give the number."""
        return self.step("acknowledge").noted.number

    def told_so(self, number: int) -> None:
        """The train hears that."""
        self.step("hear_acknowledgement", number=number)

    def runs(self, speed_mm_s: int) -> bool:
        """Whether it can run so fast now."""
        return self.step("run", speed_mm_s=speed_mm_s).speed_mm_s == speed_mm_s

    def ceilings(self) -> tuple[int, int]:
        """What the train holds to, and what the crossing has noted."""
        return self.system.held.ceiling_mm_s, self.system.noted.ceiling_mm_s


def a_promise_is_kept_until_another_is_acknowledged() -> None:
    """From the line's speed down, and up again when the crossing says so (X2)."""
    train = Train()
    assert train.runs(LINE_MM_S)
    assert not train.runs(LINE_MM_S + 1)
    assert train.runs(20_000)
    train.hear(train.lower(20_000))
    assert train.ceilings() == (20_000, 20_000)
    assert not train.runs(20_001)
    train.hear(train.ask(25_000))
    assert train.ceilings() == (20_000, 20_000)
    assert not train.runs(20_001)
    number = train.acknowledge()
    assert train.ceilings() == (20_000, 25_000)
    assert not train.runs(20_001)
    train.told_so(number)
    assert train.ceilings() == (25_000, 25_000)
    assert train.runs(25_000)
    assert not train.runs(25_001)


def a_lost_promise_is_kept_all_the_same() -> None:
    """The crossing reckons with what it heard last; the next that it hears is the newest (X2)."""
    train = Train(10_000)
    train.lower(20_000)
    assert train.ceilings() == (20_000, LINE_MM_S)
    assert not train.runs(20_001)
    train.hear(train.lower(15_000))
    assert train.ceilings() == (15_000, 15_000)


def a_lost_acknowledgement_leaves_the_train_where_it_is() -> None:
    """It may be given again; until then the crossing reckons with what it has given (X2)."""
    train = Train()
    train.hear(train.lower(20_000))
    train.hear(train.ask(25_000))
    first = train.acknowledge()
    assert train.ceilings() == (20_000, 25_000)
    assert not train.runs(20_001)
    assert train.acknowledge() == first
    train.told_so(first)
    train.told_so(first)
    assert train.ceilings() == (25_000, 25_000)


def a_promise_that_comes_again_or_late_counts_no_more() -> None:
    """Neither the one before the ask, nor the ask itself, lowers what was acknowledged since (X2)."""
    train = Train()
    low, high = train.lower(20_000), train.ask(25_000)
    train.hear(low)
    train.hear(high)
    train.told_so(train.acknowledge())
    assert train.runs(25_000)
    for old in (high, low):
        train.hear(old)
        assert train.ceilings() == (25_000, 25_000)


def an_ask_that_was_given_up_is_not_granted_later() -> None:
    """Its acknowledgement comes when the train has promised, or asked for, something else (X2)."""
    train = Train()
    train.hear(train.lower(20_000))
    train.hear(train.ask(25_000))
    late = train.acknowledge()
    train.hear(train.lower(20_000))
    assert train.ceilings() == (20_000, 20_000)
    train.told_so(late)
    assert train.ceilings() == (20_000, 20_000)
    train.hear(train.ask(28_000))
    train.told_so(late)
    assert train.ceilings() == (20_000, 20_000)
    assert not train.runs(20_001)


def an_acknowledgement_from_before_a_restart_is_reckoned_with() -> None:
    """What the crossing hears first may have been acknowledged before it restarted; what is made after that not."""
    train = Train()
    train.hear(train.lower(20_000))
    asked = train.ask(25_000)
    train.hear(asked)
    before = train.acknowledge()
    train.step("restart_crossing")
    assert train.ceilings() == (20_000, LINE_MM_S)
    train.hear(asked)
    assert train.system.noted == NOTHING
    train.hear(train.tell())
    assert train.ceilings() == (20_000, 25_000)
    train.told_so(before)
    assert train.runs(25_000)
    assert train.runs(20_000)
    train.hear(train.lower(20_000))
    train.hear(train.ask(28_000))
    assert train.ceilings() == (20_000, 20_000)


def what_a_train_does_not_keep_it_does_not_promise() -> None:
    """Not below its speed, nor below the upper end of a range that is wide; nor more than it holds to (X2, P1)."""
    train = Train()
    assert train.lower(19_999) == NOTHING
    assert train.step("lower", ceiling_mm_s=22_000, speed_most_mm_s=22_001).held == NOTHING
    assert train.step("lower", ceiling_mm_s=22_000, speed_most_mm_s=19_999).held == NOTHING
    assert train.step("lower", ceiling_mm_s=22_000, speed_most_mm_s=22_000).held == Promise(1, 22_000, 22_000)
    assert train.lower(22_001) == Promise(1, 22_000, 22_000)
    assert train.ask(22_000) == Promise(1, 22_000, 22_000)
    assert train.ask(LINE_MM_S + 1) == Promise(1, 22_000, 22_000)
    assert train.ask(LINE_MM_S) == Promise(2, 22_000, LINE_MM_S)


def who_stands_promises_to_stand() -> None:
    """A ceiling of 0; it starts when it has asked and was let (X2)."""
    train = Train(0)
    train.hear(train.lower(0))
    assert not train.runs(1)
    train.hear(train.ask(LINE_MM_S))
    assert not train.runs(1)
    train.told_so(train.acknowledge())
    assert train.runs(LINE_MM_S)


def what_is_no_promise_is_not_noted() -> None:
    """Negative ones, one that asks for less than it holds to, and beyond 200 m/s (X2)."""
    noted = Promise(1, 20_000, 20_000)
    for told in (
        Promise(2, -1, 20_000),
        Promise(2, 20_001, 20_000),
        Promise(2, 20_000, 200_001),
        Promise(1, 10_000, 10_000),
        Promise(0, 10_000, 10_000),
    ):
        assert note(noted, told) == noted
    for told in (Promise(2, 0, 200_000), Promise(3, 20_000, 20_000)):
        assert note(noted, told) == told
    assert note(NOTHING, Promise(2, 0, 20_000)) == Promise(2, 20_000, 20_000)
    assert ask(LINE_MM_S, noted, 20_001) == Promise(2, 20_000, 20_001)
    assert lower(noted, 20_000, 20_000) == Promise(2, 20_000, 20_000)
    assert note_acknowledged(Promise(2, 20_000, 25_000), 1) == Promise(2, 20_000, 25_000)


def what_nature_does_not_do_does_not_happen() -> None:
    """Nobody hears what was not told, or not acknowledged (X1, T11)."""
    train = Train()
    start = train.system
    assert train.step("hear_promise", told=Promise(1, 0, 0)) == start
    assert train.step("hear_acknowledgement", number=1) == start
    train.lower(20_000)
    held = train.system
    assert train.step("hear_promise", told=Promise(1, 0, 0)) == held


def a_promise_ends_by_an_acknowledgement_however_late() -> None:
    """Its rear is past, and what it asked for is acknowledged; it hears that on its next way to the road (X2)."""
    train = Train(10_000)
    train.hear(train.lower(12_000))
    train.hear(train.ask(LINE_MM_S))
    number = train.acknowledge()
    train.step("restart_crossing")
    assert train.ceilings() == (12_000, LINE_MM_S)
    train.hear(train.tell())
    assert train.ceilings() == (12_000, LINE_MM_S), "what is heard first counts by what it asks"
    train.told_so(number)
    assert train.ceilings() == (LINE_MM_S, LINE_MM_S)
    again = train.lower(15_000)
    train.hear(again)
    train.told_so(number)
    assert train.ceilings() == (15_000, 15_000), "the same word again ends no later promise"


WITNESSES = (
    a_promise_ends_by_an_acknowledgement_however_late,
    a_promise_is_kept_until_another_is_acknowledged,
    a_lost_promise_is_kept_all_the_same,
    a_lost_acknowledgement_leaves_the_train_where_it_is,
    a_promise_that_comes_again_or_late_counts_no_more,
    an_ask_that_was_given_up_is_not_granted_later,
    an_acknowledgement_from_before_a_restart_is_reckoned_with,
    what_a_train_does_not_keep_it_does_not_promise,
    who_stands_promises_to_stand,
    what_is_no_promise_is_not_noted,
    what_nature_does_not_do_does_not_happen,
)
