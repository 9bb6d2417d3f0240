"""The computer on board: the machines that know where the train is, and the brake, a cycle at a time (P7, T5, T12).

A cycle has two halves.  At its beginning :func:`decide` settles whether the brake is on while the train runs;
at its end :func:`sense` takes what the sensors say of that run.  Between the end of one cycle and the beginning
of the next comes all that is told: what both antennas heard in it, frame time by frame time, ends of authority, and
where a train at rest is.  So no tag is called overdue in the cycle in which it was read.

A tag is read when its reader delivers its record, and by nothing else; the unit looks up where its lists have it.

Tags and ends of authority lie on one kilometrage, each tag at its own place; its antenna is behind the front.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import (
    antenna_spacing,
    brake_demand,
    brake_watch,
    braking,
    odometry,
    restriction_ahead,
    reverse_movement,
    speed_limit,
    split,
    tag_fix,
    tag_reader,
    tag_window,
    train_length,
)
from kernel.onboard import ceiling as ceilings
from kernel.onboard.antenna_spacing import Spacing
from kernel.onboard.arithmetic import larger, smaller
from kernel.onboard.brake_demand import Known
from kernel.onboard.braking import Brake
from kernel.onboard.ceiling import Ceiling
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Motion, Readings
from kernel.onboard.restriction_ahead import NONE_LISTED
from kernel.onboard.reverse_movement import LOCATED
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_fix import Fix
from kernel.onboard.tag_reader import Frame, Level, Reader
from kernel.onboard.tag_window import NONE_AWAITED
from kernel.onboard.train_length import UNMEASURED, Length, Passing, PointKind
from kernel.onboard.way import Way
from kernel.standstill import Standstill, ThroughLine, is_braked, is_held, moves

BY_HEAD_MS, BY_TAIL_MS = 0, 1
"""One unit takes the reads of both antennas, each as it comes: the tail's of a tag is later than any that the head had
of it, whatever a clock says."""


@dataclass(frozen=True)
class Computer:
    """What the computer remembers.

    ``known``: what its machines know at the end of the newest cycle.
    ``before``: what the odometry knew a cycle earlier; it claims nothing once the train has been located anew.
    ``from_mm``: the way to the awaited tag is counted from this place.
    ``spacing``: what is known of the two antennas.
    ``length``: what is known of the train's length, measured by tags that both have read.
    ``brake``: what the brake control knows.
    ``head``, ``tail``: what the readers of the two antennas remember.
    """

    known: Known
    before: Motion
    from_mm: int
    spacing: Spacing
    length: Length
    brake: Brake
    head: Reader
    tail: Reader


def put_into_service(limits: Limits, ceiling: Ceiling, least_mm: int, most_mm: int) -> Computer:
    """Begin with a train at rest, its brake on, and its front between two places, in any order (P5, P7, T8).

    With lawful limits alone (:func:`kernel.onboard.limits.are_lawful`).
    ``ceiling``: the lowest that it has promised to a crossing, in any of its lives, and was not let go from.
    Whether motors or brake broke a bound, whether it has split, whether its tail was false and whether an antenna has
    failed is forgotten.  So all of that counts as found, until staff says otherwise: :func:`inspect_brake`,
    :func:`made_up`, :func:`mend_head` and :func:`mend_tail`, once its brake is known to hold it (T3, T12, T13).
    """
    motion = odometry.located(smaller(least_mm, most_mm), larger(least_mm, most_mm), 0)
    return Computer(
        known=Known(
            motion=motion,
            watch=brake_watch.restarted(),
            movement=LOCATED,
            limit=NO_TRACK_KNOWN,
            wholeness=split.restarted(limits.split),
            window=NONE_AWAITED,
            ahead=NONE_LISTED,
            ceiling=ceiling,
        ),
        before=odometry.past(motion),
        from_mm=0,
        spacing=antenna_spacing.restarted(),
        length=UNMEASURED,
        brake=braking.stand_still(motion.front_most_mm),
        head=tag_reader.restarted(),
        tail=tag_reader.restarted(),
    )


def place(computer: Computer) -> Way:
    """Give where the front is (P7)."""
    motion = computer.known.motion
    return Way(odometry.is_located(motion), motion.front_least_mm, motion.front_most_mm)


def standstill(limits: Limits, computer: Computer) -> Standstill:
    """Give what is told of front, speed and brake; one found weak, or that let it roll back, holds nobody (T8, T12)."""
    at, known = at_rest(limits, computer), computer.known
    return replace(at, braked_cycles=0) if known.watch.broken or known.movement.reversed else at


def at_rest(limits: Limits, computer: Computer) -> Standstill:
    """Give what is known of front, speed and brake to whoever says something of the train at rest (P7, T8, T12)."""
    motion, bounds = computer.known.motion, limits.train.brake
    return Standstill(
        known=odometry.is_located(motion),
        front_least_mm=motion.front_least_mm,
        front_most_mm=motion.front_most_mm,
        speed_least_mm_s=motion.speed_least_mm_s,
        speed_most_mm_s=motion.speed_most_mm_s,
        standstill_mm_s=bounds.standstill_mm_s,
        braked_cycles=computer.known.watch.cycles,
        response_cycles=bounds.response_cycles,
        releasable=not computer.brake.withheld,
    )


# ---- a cycle


def decide(limits: Limits, computer: Computer, may_proceed: bool, acknowledged: bool) -> Computer:
    """Decide on the brake for the cycle that begins, and whether the awaited tag is overdue (T5, T12).

    ``may_proceed``: an order lets the train proceed.  ``acknowledged``: the driver has acknowledged the brake.
    A record that was delivered in the cycle before, and that nobody has taken, counts no more: the train runs on.
    """
    way = way_to(computer, place(computer))
    known = replace(computer.known, window=tag_window.note_cycle(limits.window, computer.known.window, way))
    brake = brake_demand.decide(limits.train, computer.brake, known, may_proceed, acknowledged)
    watch = known.watch if brake.applied else brake_watch.released(known.watch)
    return replace(
        computer,
        known=replace(known, watch=watch),
        brake=brake,
        head=tag_reader.next_cycle(computer.head),
        tail=tag_reader.next_cycle(computer.tail),
    )


def sense(limits: Limits, computer: Computer, readings: Readings, tail: TailReadings) -> Computer:
    """Take what the sensors of head and tail say at the end of the cycle (P1, P5, P7)."""
    known = computer.known
    motion = odometry.note_cycle(limits.sensors, known.motion, readings)
    located = odometry.is_located(motion)
    least_mm_s, most_mm_s = motion.speed_least_mm_s, motion.speed_most_mm_s
    sensed = replace(
        computer,
        known=Known(
            motion=motion,
            watch=brake_watch.note_cycle(
                limits.train.brake, known.watch, computer.brake.applied, located, least_mm_s, most_mm_s
            ),
            movement=reverse_movement.note_cycle(limits.reverse, known.movement, readings),
            limit=known.limit,
            wholeness=split.note_cycle(limits.split, known.wholeness, tail),
            window=known.window,
            ahead=known.ahead,
            ceiling=known.ceiling,
        ),
        before=known.motion,
    )
    return note_entered(sensed)


def note_entered(computer: Computer) -> Computer:
    """Take the listed restrictions where the front may be for entered, whether their tags were read or not (T5, T12).

    So none is forgotten with its list when a tag is missed: it holds until another tag is read.
    """
    known, front = computer.known, place(computer)
    curve = restriction_ahead.may_be_entered(known.ahead.curve_mm, front)
    turnout = restriction_ahead.may_be_entered(known.ahead.turnout_mm, front)
    return replace(computer, known=replace(known, limit=speed_limit.note_entered(known.limit, curve, turnout)))


# ---- fixes


def note_fix(computer: Computer, least_mm: int, most_mm: int) -> Computer:
    """Narrow the range by a fix, as a feature of the track gives one: from where to where the front is now (P3, P7)."""
    motion = odometry.note_fix(computer.known.motion, least_mm, most_mm)
    return replace(computer, known=replace(computer.known, motion=motion))


# ---- tags


def place_of_read(computer: Computer) -> Way:
    """Give where the front was when an antenna read something within the newest cycle (P7)."""
    return tag_fix.place_of_read(computer.before, computer.known.motion)


def way_to(computer: Computer, at: Way) -> Way:
    """Give the way from where it is counted to a place of the front (T5, P7)."""
    return Way(at.known, at.least_mm - computer.from_mm, at.most_mm - computer.from_mm)


def way_to_tag_mm(limits: Limits, computer: Computer, place_mm: int) -> int:
    """Give how far it is from there to where the head reads a tag that is listed at ``place_mm`` (T1, T5)."""
    return place_mm + limits.tags.antenna_mm - computer.from_mm


def await_tag(limits: Limits, computer: Computer, place_mm: int, kind: int) -> Computer:
    """Await the tag that is listed at this place as the next; the way to it is counted from behind the train (T5).

    ``kind``: as listed; where the list does not say it, the worst (``tag_kind.UNKNOWN``).  What is listed beyond it
    is told anew (:func:`note_listed`).  While one is overdue nobody knows the track, and the train is located first.
    """
    if computer.known.window.passed:
        return computer
    begun = replace(computer, from_mm=computer.known.motion.front_least_mm - limits.window.tolerance_mm)
    away_mm = way_to_tag_mm(limits, begun, place_mm)
    window = tag_window.await_tag(away_mm, away_mm)
    return note_listed(
        limits, replace(begun, known=replace(begun.known, window=window, ahead=NONE_LISTED)), place_mm, kind
    )


def note_listed(limits: Limits, computer: Computer, place_mm: int, kind: int) -> Computer:
    """Take a tag that is listed ahead, and the kind that the list has for it: nothing restricts before it (T1, T12).

    It is told in the same cycle as the end of authority beyond it, or before.
    """
    ahead = restriction_ahead.note_listed(computer.known.ahead, kind, begins_from_mm(limits, place_mm))
    return note_entered(replace(computer, known=replace(computer.known, ahead=ahead)))


def begins_from_mm(limits: Limits, place_mm: int) -> int:
    """Give where at the nearest a listed tag's track begins: at the tag, which the front reaches unread (T1, T12)."""
    return place_mm - limits.tags.error_mm


def await_none(computer: Computer) -> Computer:
    """Await no tag, unless one is overdue: no order says which is next, and no list what lies ahead (T5, T12)."""
    if computer.known.window.passed:
        return computer
    return note_entered(replace(computer, known=replace(computer.known, window=NONE_AWAITED, ahead=NONE_LISTED)))


def awaits(limits: Limits, computer: Computer, place_mm: int) -> bool:
    """Tell whether the tag that is listed at this place is awaited (T5)."""
    window = computer.known.window
    return window.expected and window.most_mm == way_to_tag_mm(limits, computer, place_mm)


def reads_in_window(limits: Limits, computer: Computer, place_mm: int) -> bool:
    """Tell whether the head read a tag within the newest cycle where the list has it (T5)."""
    away_mm = way_to_tag_mm(limits, computer, place_mm)
    window = tag_window.await_tag(away_mm, away_mm)
    return tag_window.in_window(limits.window, window, way_to(computer, place_of_read(computer)))


def fix(limits: Limits, computer: Computer, place_mm: int) -> Fix:
    """Give where the front is by a tag listed at ``place_mm`` that the head read within the newest cycle (P7, T2)."""
    return tag_fix.fix_of(limits.tags, computer.before, computer.known.motion, place_mm)


def note_head_frame(limits: Limits, computer: Computer, frame: Frame, level: Level) -> Computer:
    """Take what the head's antenna heard in one frame time of the newest cycle, and its transmit level (T1, T13)."""
    return replace(computer, head=tag_reader.note_frame(limits.reader, computer.head, frame, level))


def note_tail_frame(limits: Limits, computer: Computer, frame: Frame, level: Level) -> Computer:
    """Take what the tail's antenna heard in one frame time of the newest cycle, and its transmit level (T1, T13)."""
    return replace(computer, tail=tag_reader.note_frame(limits.reader, computer.tail, frame, level))


def read_by_head(limits: Limits, computer: Computer, place_mm: int) -> Computer:
    """Take the record that the head's reader delivers: where the train is, and on which track (P7, T12, T13).

    While it delivers none nothing is taken, and a record is taken once.  ``place_mm``: where the list has this tag.
    It narrows the range first, and the tail's follows.
    One that was read elsewhere, or before the train was located, is as one of no list: it is another, or the train has
    run on since by who knows how much.
    """
    if not tag_reader.delivers(computer.head):
        return computer
    uid, kind = computer.head.held.uid, computer.head.held.kind
    if not reads_in_window(limits, computer, place_mm):
        return read_unlisted(computer)
    found = fix(limits, computer, place_mm)
    fixed = note_fix(computer, found.least_mm, found.most_mm)
    at = place_of_read(fixed)
    read = replace(
        fixed,
        known=replace(fixed.known, limit=speed_limit.note_tag(computer.known.limit, kind, at.known, at.most_mm)),
        spacing=antenna_spacing.note_head_read(computer.spacing, uid, at),
        length=train_length.note_head_pass(limits.length, computer.length, tag_passed(fixed, uid, BY_HEAD_MS)),
        head=tag_reader.taken(computer.head),
    )
    return note_entered(read)


def read_unlisted(computer: Computer) -> Computer:
    """Take the record that the head's reader delivers, if no list has that tag: nobody knows what track it begins (T5).

    Whatever may lie from it on restricts the train (T12).
    """
    if not tag_reader.delivers(computer.head):
        return computer
    limit = speed_limit.note_unlisted_tag(computer.known.limit)
    return replace(computer, known=replace(computer.known, limit=limit), head=tag_reader.taken(computer.head))


def read_by_tail(limits: Limits, computer: Computer) -> Computer:
    """Take the record that the tail's reader delivers: is it as far behind the head as preset (T13, T3)?

    While it delivers none nothing is taken, and a record is taken once.  If it is, that tells how long the train is;
    by another's antenna nothing is measured (P4).
    """
    if not tag_reader.delivers(computer.tail):
        return computer
    uid = computer.tail.held.uid
    spacing = antenna_spacing.note_tail_read(limits.spacing, computer.spacing, uid, place_of_read(computer))
    compared = replace(computer, spacing=spacing, tail=tag_reader.taken(computer.tail))
    if not antenna_spacing.is_healthy(spacing):
        return compared
    passed = tag_passed(computer, uid, BY_TAIL_MS)
    return replace(compared, length=train_length.note_tail_pass(limits.length, computer.length, passed))


def tag_passed(computer: Computer, uid: int, time_ms: int) -> Passing:
    """Give what the length is measured by, when an antenna read a tag within the newest cycle (P4, T3)."""
    at, before, motion = place_of_read(computer), computer.before, computer.known.motion
    return Passing(
        kind=PointKind.TAG,
        point=uid,
        time_ms=time_ms,
        known=at.known,
        front_least_mm=at.least_mm,
        front_most_mm=at.most_mm,
        speed_most_mm_s=larger(0, larger(before.speed_most_mm_s, motion.speed_most_mm_s)),
    )


def through_line(limits: Limits, computer: Computer, answers: bool) -> ThroughLine:
    """Give what is known of the way to the tail; ``answers``: its signal comes over the line (T3, T13, P5).

    The tail of a train that has rolled back too far may read a pair of tags in reverse: it counts no more (T2).  Nor
    does one that may be over a tag which the head has missed, since a wide range has not called that overdue yet.
    A train that was measured as another than is written, or had a false tail, is not the one that was found whole: a
    part of it may stand elsewhere (P4, P5).
    """
    return ThroughLine(
        answers=answers,
        is_intact=split.is_intact(limits.split, computer.known.wholeness)
        and not computer.spacing.broken
        and is_as_long_as_written(limits, computer),
        fits=antenna_spacing.is_healthy(computer.spacing)
        and not computer.known.movement.reversed
        and finds_a_missed_tag(limits, computer),
    )


def finds_a_missed_tag(limits: Limits, computer: Computer) -> bool:
    """Tell whether a tag that the head had missed would have been overdue when the newest cycle began (T2, T5)."""
    before = computer.before
    width_mm = before.front_most_mm - before.front_least_mm
    return odometry.is_located(before) and width_mm <= limits.window.tail_width_mm


def is_as_long_as_written(limits: Limits, computer: Computer) -> bool:
    """Tell whether no measurement shows the train longer than is written, or another than it was (P4)."""
    length = computer.length
    return not train_length.contradicts_the_line(limits.length, length) and not train_length.contradicts_itself(length)


# ---- what is told


def made_up(limits: Limits, computer: Computer) -> Computer:
    """Take the train for whole, and its antennas for as far apart as is written: its staff has found it so (P5, T3).

    Who inspects a train walks along it while its brake holds it; of any other nobody's word is taken.  One that has
    lost its position is located first.  Of each antenna it is said by itself that it reads.
    """
    if not is_held(at_rest(limits, computer)):
        return computer
    return replace(
        computer,
        known=replace(computer.known, wholeness=split.made_up(limits.split)),
        spacing=antenna_spacing.preset(limits.antennas_mm),
        length=train_length.note_formation_changed(computer.length),
    )


def inspect_brake(limits: Limits, computer: Computer) -> Computer:
    """Take motors and brake of a held train for sound, and watch them anew: staff has tried them (T12)."""
    if not is_held(at_rest(limits, computer)):
        return computer
    watch = brake_watch.inspected(computer.known.watch, computer.known.motion.speed_most_mm_s)
    return replace(computer, known=replace(computer.known, watch=watch))


def mend_head(limits: Limits, computer: Computer) -> Computer:
    """Take the head's antenna for sound: staff has mended it, or tried it and found it so; supervised (T13).

    Who tries an antenna is below the train, while its brake holds it at rest; of any other nobody's word is taken.
    """
    if not is_held(at_rest(limits, computer)):
        return computer
    return replace(computer, head=tag_reader.mended())


def mend_tail(limits: Limits, computer: Computer) -> Computer:
    """Take the tail's antenna for sound, as the head's: of a train that its brake holds at rest (T13)."""
    if not is_held(at_rest(limits, computer)):
        return computer
    return replace(computer, tail=tag_reader.mended())


def note_place(limits: Limits, computer: Computer, least_mm: int, most_mm: int) -> Computer:
    """Narrow the range by what a person says who sees the train stand: from where to where its front may be (P7, T8).

    He may say on which side of a boundary it is, and name either place first.  The wheel stays trusted, as it would not
    if it were located anew.  One that is not held may be elsewhere by the time he has said it.
    """
    if not is_held(at_rest(limits, computer)):
        return computer
    return note_fix(computer, smaller(least_mm, most_mm), larger(least_mm, most_mm))


def keep_to(limits: Limits, computer: Computer, ceiling: Ceiling) -> Computer:
    """Keep to a ceiling of speed, if that can still be done; then, and no sooner, may it be promised (X2, T12, ours).

    A higher one may always be taken, once the crossing has let it.  Who has lost its position takes no lower one.
    """
    known = computer.known
    if ceiling.most_mm_s < known.ceiling.most_mm_s and not odometry.is_located(known.motion):
        return computer
    taken = ceilings.take(limits.train.brake, known.ceiling, ceiling, known.motion.speed_most_mm_s)
    return replace(computer, known=replace(known, ceiling=taken))


def withhold_end(computer: Computer) -> Computer:
    """Brake, until an end of authority is taken (T4, T12)."""
    return replace(computer, brake=braking.withhold_end(computer.brake))


def is_braked_to_rest(limits: Limits, computer: Computer) -> bool:
    """Tell whether the brake that is guaranteed has stopped the train by now, whether its speed is known or not (T12).

    Until then nobody's word that it stands releases the brake: a train that has lost its position may still run fast.
    """
    is_slow = computer.known.watch.limit_mm_s <= limits.train.brake.standstill_mm_s
    return is_slow and is_braked(at_rest(limits, computer))


def locate(limits: Limits, computer: Computer, least_mm: int, most_mm: int) -> Computer:
    """Begin anew at rest with the front between two places; not before the brake has brought it to rest (P7, T8).

    Nor while it is known to move: a weak brake does not stop it in the time that is reckoned with.
    What was found of motors, brake, wholeness, antennas and length stays, and so does the ceiling.  Restrictions lay on
    the kilometrage of before: until the next tag all of them hold.  If ends were changed, either antenna may be the
    head's now: one that has failed makes both count as failed.
    """
    if not is_braked_to_rest(limits, computer) or moves(at_rest(limits, computer)):
        return computer
    way_mm, watch = computer.known.motion.way_mm, computer.known.watch
    motion = odometry.located(smaller(least_mm, most_mm), larger(least_mm, most_mm), way_mm)
    return Computer(
        known=replace(
            computer.known,
            motion=motion,
            watch=replace(watch, limit_mm_s=0),
            movement=LOCATED,
            limit=NO_TRACK_KNOWN,
            window=NONE_AWAITED,
            ahead=NONE_LISTED,
        ),
        before=odometry.past(motion),
        from_mm=0,
        spacing=antenna_spacing.turned(computer.spacing),
        length=train_length.note_kilometrage_changed(computer.length),
        brake=braking.stand_still(motion.front_most_mm),
        head=tag_reader.turned(computer.head, computer.tail),
        tail=tag_reader.turned(computer.tail, computer.head),
    )
