"""Contracts on the polling cycle, for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.tram.cycle import Answer, CycleLimits, Heard, is_fresh, is_in_slot, note_answer, note_cycle, older

LIMITS = CycleLimits(request_ms=1_200, slot_ms=700, answer_ms=600)


def answers_in_two_slots_do_not_meet(slot: int, other: int, at_ms: int, also_ms: int) -> None:
    """One is over before the other begins (002, figure 2; G3)."""
    assert 0 <= slot < other <= 3
    assert is_in_slot(LIMITS, slot, at_ms)
    assert is_in_slot(LIMITS, other, also_ms)
    assert at_ms + LIMITS.answer_ms <= also_ms


def what_is_no_answer_changes_nothing(is_sound: bool, is_asked: bool, at_ms: int, age_ms: int) -> None:
    """Damaged, of another tram, or outside its slot (G6)."""
    assert not is_sound or not is_asked or not is_in_slot(LIMITS, 1, at_ms)
    heard = Heard(1, False, 0, False)
    assert note_answer(LIMITS, heard, Answer(is_sound, is_asked, at_ms, age_ms)) == heard


def an_unanswered_cycle_is_not_known(is_known: bool, age_ms: int, answered: bool) -> None:
    """One is too many (G3)."""
    assert isinstance(age_ms, int)
    assert is_fresh(note_cycle(Heard(1, is_known, age_ms, answered))) == (answered and age_ms <= 11_000)


def nothing_grows_fresh(is_known: bool, age_ms: int, answered: bool, elapsed_ms: int) -> None:
    """By waiting (G3)."""
    assert elapsed_ms >= 0
    heard = Heard(1, is_known, age_ms, answered)
    assert not is_fresh(older(heard, elapsed_ms)) or is_fresh(heard)
