"""Tag reader: a tag's record is taken when two frames of the last four say the same (T1, T16, T13).

The reader is told of every frame time, whether a frame came or not, so that what it remembers is never
older than four of them (the paper's 4C2, which it leaves open; 000, 5).  One frame proves nothing: its
CRC may have passed by chance.  The antenna watches itself by the transmit level in its detection loop
(000, 3.5.2); beyond its limits it is deaf until it is mended (latched; ours).

Ranges: whatever fits 64 bits.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import smaller


@dataclass(frozen=True)
class Frame:
    """What came in one frame time (T1).

    ``valid``: a frame came, its CRC is right and its format known; if not, the rest says nothing.
    ``uid``: the tag's number, its 64 bits as a signed integer; ``block``, ``distance_mm``, ``kind``: its record.
    """

    valid: bool
    uid: int
    block: int
    distance_mm: int
    kind: int


NO_FRAME = Frame(valid=False, uid=0, block=0, distance_mm=0, kind=0)


@dataclass(frozen=True)
class Level:
    """The transmit level in the antenna's detection loop; ``valid``: it was measured in this frame time (T13)."""

    mv: int
    valid: bool


@dataclass(frozen=True)
class ReaderLimits:
    """The written limits (T13, T16).

    ``least_mv``, ``most_mv``: a sound antenna's transmit level.
    ``gap_frames``: after so many frame times without a frame a tag has passed; at least 1.
    """

    least_mv: int
    most_mv: int
    gap_frames: int


@dataclass(frozen=True)
class Reader:
    """What the reader remembers (T1, T16).

    ``newest``, ``second``, ``third``: the last three frames.
    ``held``: the record delivered last, until a gap.  ``fresh``: delivered in this frame time.
    ``quiet_frames``: frame times since a valid frame, as far as they count.
    ``healthy``: the antenna's level has been right since the antenna was mended.
    """

    newest: Frame
    second: Frame
    third: Frame
    held: Frame
    fresh: bool
    quiet_frames: int
    healthy: bool


def mended() -> Reader:
    """Begin with an antenna that staff has found sound: the supervised reset (T13)."""
    return Reader(
        newest=NO_FRAME,
        second=NO_FRAME,
        third=NO_FRAME,
        held=NO_FRAME,
        fresh=False,
        quiet_frames=0,
        healthy=True,
    )


def restarted() -> Reader:
    """Begin after a restart: whether the antenna had failed is forgotten, so it counts as failed (T13, T8)."""
    return replace(mended(), healthy=False)


def turned(reader: Reader, other: Reader) -> Reader:
    """Begin after a change of ends, or at another place: either of a train's antennas may be this one now (T13, T3).

    So both count as failed while one of them does.
    """
    return mended() if reader.healthy and other.healthy else restarted()


def next_cycle(reader: Reader) -> Reader:
    """Forget the frames of before when a cycle of the computer begins, and what nobody took of them (T1, P7).

    Where the train was is known within the newest cycle alone, so a record's two frames come within one.  The record
    delivered last stays held: no passing is delivered twice.
    """
    return replace(reader, newest=NO_FRAME, second=NO_FRAME, third=NO_FRAME, fresh=False)


def taken(reader: Reader) -> Reader:
    """Wait for the next record: what was delivered in this frame time has been taken (T1)."""
    return replace(reader, fresh=False)


def is_sound(limits: ReaderLimits, level: Level) -> bool:
    """Tell whether the detection loop shows a sound antenna; a level not measured shows none (T13)."""
    return level.valid and limits.least_mv <= level.mv <= limits.most_mv


def note_frame(limits: ReaderLimits, reader: Reader, frame: Frame, level: Level) -> Reader:
    """Take what came in one frame time, and the transmit level in it (T1, T13, T16).

    A record is delivered once two frames of the last four agree in it, this frame being one of them;
    the same record again only after another tag's, or after a gap.
    """
    if not reader.healthy or not is_sound(limits, level):
        return restarted()
    agrees = frame.valid and (frame == reader.newest or frame == reader.second or frame == reader.third)
    quiet_frames = 0 if frame.valid else smaller(reader.quiet_frames + 1, limits.gap_frames)
    held = NO_FRAME if quiet_frames >= limits.gap_frames else reader.held
    return replace(
        reader,
        newest=frame,
        second=reader.newest,
        third=reader.second,
        held=frame if agrees else held,
        fresh=agrees and frame != reader.held,
        quiet_frames=quiet_frames,
    )


def delivers(reader: Reader) -> bool:
    """Tell whether a tag's record, ``held``, is delivered in this frame time (T1, T16)."""
    return reader.fresh
