"""The frames between station and trams, byte for byte (002, table 1; G3).

A request is 309 bytes: bit synchronisation 90, frame synchronisation 4, identification 6, station 1, and
four vehicles' data of 52.  A response is 153: the same, and one vehicle's data.  Vehicle data are 26 bytes,
each 2 of them followed by 2 of error correction.  What the fields hold the paper says by name alone; how
they are coded is ours.

The code is that of the tags' radio (``kernel.error_correction``), of 2 bytes at a time: in each block of 4
bytes any burst of up to 4 bits is corrected, and any of up to 8 is found out.  Beyond that it may mend to
something else, and table 1 has no check sum; so four of the six bytes of identification are one, over the
station and all vehicle data as they were before coding (CRC-32, ours).  What precedes the data is not
protected by the code: if a bit of it is wrong there, the frame is for nobody, and is lost.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kernel.error_correction import Damaged, protect, restore
from kernel.tram.dispatching import Order, Report

BIT_SYNC = b"\xaa" * 90
FRAME_SYNC = b"\x1a\xcf\xfc\x1d"
REQUEST_ID = b"TQ"
RESPONSE_ID = b"TA"
"""Ours; a request is no response to another station that hears it.  Four bytes of check sum follow."""
CRC_POLYNOMIAL = 0xEDB88320
CRC_START = 0xFFFFFFFF
VEHICLES = 4
"""Up 1, up 2, down 1, down 2 (table 1)."""
DATA_BYTES = 26
CODED_BYTES = 52
HEAD_BYTES = 90 + 4 + 6 + 1
REQUEST_BYTES = HEAD_BYTES + VEHICLES * CODED_BYTES
RESPONSE_BYTES = HEAD_BYTES + CODED_BYTES
NOBODY = 0
"""The vehicle number in a slot that asks for no tram (ours)."""
MOST_MM = (1 << 48) - 1


class Unfit(Enum):
    """Why a frame is not taken, or data are no frame (G3)."""

    WRONG_LENGTH = "not as long as table 1 has it"
    NOT_OURS = "other synchronisation, identification or station"
    DAMAGED = "more errors than the code corrects"
    NO_SENSE = "a field has a value that nobody gives it"
    OTHER_VEHICLE = "from another tram than was asked"


class Gps(Enum):
    """The state of GPS (table 1: GPS 情報; ours)."""

    LOST = 0
    PLAIN = 1
    DIFFERENTIAL = 2


@dataclass(frozen=True)
class VehicleData:
    """The 26 bytes of one tram (table 1).

    ``line``: 系統 and up or down, together.  ``stands``: 停車確認, the tram says that it stands; ``noted``:
    停車確認済み, the station has noted it.  ``left``: 出発確認.  ``holds``: 出発抑止.  ``recovers``: 回復運転.
    ``stop``, ``place_mm``: the place, 2 and 6 bytes: the stop that this is about, and the kilometrage.
    ``time_ms``: GPS time in ms.  ``delay_ms``: 送信遅延時間.  ``leaves_at``: 行先駅.
    """

    line: int
    vehicle: int
    kind: int
    stands: bool
    noted: bool
    left: bool
    holds: bool
    gps: Gps
    stop: int
    place_mm: int
    time_ms: int
    recovers: bool
    delay_ms: int
    leaves_at: int


def makes_sense(data: VehicleData) -> bool:
    """Tell whether every number fits its bytes, and no field contradicts another (G3, G6).

    Nobody holds and recovers; no tram that has left stands.
    """
    return (
        0 <= data.line <= 0xFF
        and 0 <= data.vehicle <= 0xFF
        and 0 <= data.kind <= 0xFF
        and 0 <= data.stop <= 0xFF
        and 0 <= data.leaves_at <= 0xFF
        and 0 <= data.place_mm <= MOST_MM
        and 0 <= data.time_ms <= MOST_MM
        and 0 <= data.delay_ms <= 0xFFFF
        and not (data.holds and data.recovers)
        and not (data.left and data.stands)
    )


# ---- vehicle data


def plain_bytes(data: VehicleData) -> bytes:
    """Put the fields one after the other, the highest byte first; they fit (table 1; G3)."""
    flags = (data.stands, data.noted, data.left, data.holds)
    return (
        bytes((data.line, data.vehicle, data.kind))
        + bytes(1 if flag else 0 for flag in flags)
        + bytes((data.gps.value,))
        + data.stop.to_bytes(2, "big")
        + data.place_mm.to_bytes(6, "big")
        + data.time_ms.to_bytes(6, "big")
        + bytes((1 if data.recovers else 0,))
        + data.delay_ms.to_bytes(2, "big")
        + bytes((data.leaves_at,))
    )


def read_plain(plain: bytes) -> VehicleData | Unfit:
    """Read the 26 bytes; what nobody writes makes no sense (G3)."""
    flags = (*plain[3:7], plain[22])
    if any(flag > 1 for flag in flags) or plain[7] > Gps.DIFFERENTIAL.value:
        return Unfit.NO_SENSE
    data = VehicleData(
        line=plain[0],
        vehicle=plain[1],
        kind=plain[2],
        stands=plain[3] == 1,
        noted=plain[4] == 1,
        left=plain[5] == 1,
        holds=plain[6] == 1,
        gps=Gps(plain[7]),
        stop=int.from_bytes(plain[8:10], "big"),
        place_mm=int.from_bytes(plain[10:16], "big"),
        time_ms=int.from_bytes(plain[16:22], "big"),
        recovers=plain[22] == 1,
        delay_ms=int.from_bytes(plain[23:25], "big"),
        leaves_at=plain[25],
    )
    return data if makes_sense(data) else Unfit.NO_SENSE


def coded(data: VehicleData) -> bytes | Unfit:
    """Give the 52 bytes of a tram: after each 2 bytes 2 of error correction (table 1, note 2; G3)."""
    if not makes_sense(data):
        return Unfit.NO_SENSE
    plain = plain_bytes(data)
    return b"".join(protect(plain[place : place + 2]) for place in range(0, DATA_BYTES, 2))


def decoded(received: bytes) -> VehicleData | Unfit:
    """Read 52 bytes, mended where the code can; never raises (G3, G6)."""
    if len(received) != CODED_BYTES:
        return Unfit.WRONG_LENGTH
    plain = b""
    for place in range(0, CODED_BYTES, 4):
        pair = restore(received[place : place + 4])
        if isinstance(pair, Damaged):
            return Unfit.DAMAGED
        plain = plain + pair
    return read_plain(plain)


# ---- frames


def check_of(identification: bytes, station: int, plain: bytes) -> bytes:
    """Give the check sum of what a frame says: CRC-32, over what frame it is as well (G3, G6; ours)."""
    rest = CRC_START
    for byte in identification + bytes((station & 0xFF,)) + plain:
        rest = rest ^ byte
        for _ in range(8):
            rest = rest >> 1 ^ (CRC_POLYNOMIAL if rest & 1 else 0)
    return (rest ^ CRC_START).to_bytes(4, "big")


def frame_of(identification: bytes, station: int, vehicles: tuple[VehicleData, ...]) -> bytes | Unfit:
    """Give a frame (table 1; G3)."""
    if not 0 <= station <= 0xFF or not all(makes_sense(data) for data in vehicles):
        return Unfit.NO_SENSE
    plain = b"".join(plain_bytes(data) for data in vehicles)
    body = b"".join(protect(plain[place : place + 2]) for place in range(0, len(plain), 2))
    check = check_of(identification, station, plain)
    return BIT_SYNC + FRAME_SYNC + identification + check + bytes((station,)) + body


def request(station: int, vehicles: tuple[VehicleData, VehicleData, VehicleData, VehicleData]) -> bytes | Unfit:
    """Give a station's request: what it has for up to four trams, and asks them (table 1; G3)."""
    return frame_of(REQUEST_ID, station, vehicles)


def response(station: int, data: VehicleData) -> bytes | Unfit:
    """Give a tram's answer to a station (table 1; G3)."""
    return frame_of(RESPONSE_ID, station, (data,))


def read_frame(frame: bytes, identification: bytes, station: int) -> tuple[VehicleData, ...] | Unfit:
    """Read all data of a frame for this station; its length is right (G3, G6).

    The bits of synchronisation before it have done their service.  All of it is refused if any of it is
    damaged: a code that has failed in one place may have mended wrongly in another.
    """
    is_ours = frame[90:96] == FRAME_SYNC + identification and frame[100:HEAD_BYTES] == bytes((station & 0xFF,))
    if not is_ours:
        return Unfit.NOT_OURS
    found: tuple[VehicleData, ...] = ()
    for begins in range(HEAD_BYTES, len(frame), CODED_BYTES):
        data = decoded(frame[begins : begins + CODED_BYTES])
        if isinstance(data, Unfit):
            return data
        found = (*found, data)
    plain = b"".join(plain_bytes(data) for data in found)
    return found if frame[96:100] == check_of(identification, station, plain) else Unfit.DAMAGED


def slot_of(frame: bytes, station: int, vehicle: int) -> int | Unfit:
    """Give the slot in which a request asks a tram, from 0; the first of several that are for it (G3, G6)."""
    if len(frame) != REQUEST_BYTES:
        return Unfit.WRONG_LENGTH
    found = read_frame(frame, REQUEST_ID, station)
    if isinstance(found, Unfit):
        return found
    for slot in range(VEHICLES):
        if found[slot].vehicle == vehicle != NOBODY:
            return slot
    return Unfit.OTHER_VEHICLE


def read_request(frame: bytes, station: int, vehicle: int) -> VehicleData | Unfit:
    """Give what a request says to a tram that stands at a station; never raises (G3, G6)."""
    slot = slot_of(frame, station, vehicle)
    if isinstance(slot, Unfit):
        return slot
    begins = HEAD_BYTES + slot * CODED_BYTES
    return decoded(frame[begins : begins + CODED_BYTES])


def read_response(frame: bytes, station: int, vehicle: int) -> VehicleData | Unfit:
    """Give what the tram asked answered to this station; never raises (G3, G6)."""
    if len(frame) != RESPONSE_BYTES:
        return Unfit.WRONG_LENGTH
    found = read_frame(frame, RESPONSE_ID, station)
    if isinstance(found, Unfit):
        return found
    return found[0] if found[0].vehicle == vehicle else Unfit.OTHER_VEHICLE


# ---- to and from the machines


def report_of(data: VehicleData) -> Report:
    """Give what a tram tells; without GPS it does not stand anywhere (G2, G3)."""
    return Report(
        stop=data.stop,
        left=data.left,
        stands=data.stands and data.gps != Gps.LOST,
        leaves_at=data.leaves_at,
        made_ms=data.time_ms,
    )


def order_of(data: VehicleData) -> Order:
    """Give what a tram is told (G4, G5)."""
    return Order(stop=data.stop, holds=data.holds, recovers=data.recovers, made_ms=data.time_ms)
