"""Frames of table 1: they round-trip, are mended and refused as promised, and nothing crashes them (G3)."""

from __future__ import annotations

import zlib
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.tram import frames
from kernel.tram.dispatching import Order, Report
from kernel.tram.frames import (
    BIT_SYNC,
    CODED_BYTES,
    FRAME_SYNC,
    HEAD_BYTES,
    MOST_MM,
    NOBODY,
    REQUEST_BYTES,
    RESPONSE_BYTES,
    Gps,
    Unfit,
    VehicleData,
)

BYTE = st.integers(0, 255)
FLAG = st.booleans()
DATA = st.builds(
    VehicleData,
    line=BYTE,
    vehicle=st.integers(1, 255),
    kind=BYTE,
    stands=FLAG,
    noted=FLAG,
    left=FLAG,
    holds=FLAG,
    gps=st.sampled_from(Gps),
    stop=BYTE,
    place_mm=st.integers(0, MOST_MM),
    time_ms=st.integers(0, MOST_MM),
    recovers=FLAG,
    delay_ms=st.integers(0, 0xFFFF),
    leaves_at=BYTE,
).filter(frames.makes_sense)
CAR = VehicleData(1, 13, 2, True, False, False, False, Gps.DIFFERENTIAL, 7, 3_141_592, 1_100_000_000_000, True, 350, 20)
EMPTY = VehicleData(0, NOBODY, 0, False, False, False, False, Gps.LOST, 0, 0, 0, False, 0, 0)


def coded(data: VehicleData) -> bytes:
    """The 52 bytes of data that make sense."""
    made = frames.coded(data)
    assert isinstance(made, bytes)
    return made


def flipped(frame: bytes, *bits: int) -> bytes:
    """A frame with some bits turned round."""
    number = int.from_bytes(frame, "big")
    for bit in bits:
        number ^= 1 << (8 * len(frame) - 1 - bit)
    return number.to_bytes(len(frame), "big")


def the_request(*cars: VehicleData, station: int = 4) -> bytes:
    """A request with so many trams, the other slots empty."""
    slots = (*cars, *[EMPTY] * (4 - len(cars)))
    frame = frames.request(station, (slots[0], slots[1], slots[2], slots[3]))
    assert isinstance(frame, bytes)
    return frame


def the_response(data: VehicleData, station: int = 4) -> bytes:
    """A response."""
    frame = frames.response(station, data)
    assert isinstance(frame, bytes)
    return frame


def test_lengths_are_those_of_table_1() -> None:
    assert (REQUEST_BYTES, RESPONSE_BYTES) == (90 + 4 + 6 + 1 + 4 * 52, 90 + 4 + 6 + 1 + 52) == (309, 153)
    request, response = the_request(CAR), the_response(CAR)
    assert (len(request), len(response), len(coded(CAR))) == (309, 153, 52)
    assert request.startswith(BIT_SYNC + FRAME_SYNC)
    assert request[100] == response[100] == 4
    assert response[HEAD_BYTES:] == request[HEAD_BYTES : HEAD_BYTES + CODED_BYTES] == coded(CAR)


def test_fields_are_where_table_1_has_them() -> None:
    """Each two bytes are followed by two of error correction; the widths are the paper's."""
    body = coded(CAR)
    plain = b"".join(body[place : place + 2] for place in range(0, CODED_BYTES, 4))
    widths = (1, 1, 1, 1, 1, 1, 1, 1, 8, 6, 1, 2, 1)
    assert sum(widths) == len(plain) == 26
    begins = [sum(widths[:place]) for place in range(len(widths))]
    fields = [plain[begin : begin + width] for begin, width in zip(begins, widths, strict=True)]
    values = [int.from_bytes(field, "big") for field in fields]
    assert values == [1, 13, 2, 1, 0, 0, 0, 2, 7 << 48 | 3_141_592, 1_100_000_000_000, 1, 350, 20]


@given(DATA, BYTE)
def test_what_is_sent_is_read(data: VehicleData, station: int) -> None:
    assert frames.decoded(coded(data)) == data
    assert frames.read_response(the_response(data, station), station, data.vehicle) == data
    assert frames.read_request(the_request(CAR, data, station=station), station, data.vehicle) in (data, CAR)


def test_each_single_bit_of_the_data_is_mended() -> None:
    body = coded(CAR)
    for bit in range(8 * CODED_BYTES):
        assert frames.decoded(flipped(body, bit)) == CAR


def test_bursts_of_four_bits_in_a_block_are_mended_and_of_eight_found_out() -> None:
    """In each block of 4 bytes, wherever they begin; so a burst of 36 bits is mended if each block has only 4."""
    body = coded(CAR)
    for block in range(0, 8 * CODED_BYTES, 32):
        for begin in range(32):
            for pattern in range(1, 16):
                bits = [begin + place for place in range(4) if pattern >> place & 1]
                if all(bit < 32 for bit in bits):
                    assert frames.decoded(flipped(body, *(block + bit for bit in bits))) == CAR
            for pattern in range(1, 256):
                bits = [begin + place for place in range(8) if pattern >> place & 1]
                if all(bit < 32 for bit in bits):
                    found = frames.decoded(flipped(body, *(block + bit for bit in bits)))
                    assert found == CAR or found == Unfit.DAMAGED


def test_any_two_bits_of_the_data_are_mended_or_found_out() -> None:
    body = coded(CAR)
    chance = Random(2)
    for _ in range(3_000):
        found = frames.decoded(flipped(body, *chance.sample(range(8 * CODED_BYTES), 2)))
        assert found == CAR or found == Unfit.DAMAGED


def test_a_wrong_bit_before_the_data_loses_the_frame_but_not_in_the_bit_synchronisation() -> None:
    for frame, read in ((the_response(CAR), frames.read_response), (the_request(CAR), frames.read_request)):
        for bit in range(8 * HEAD_BYTES):
            found = read(flipped(frame, bit), 4, 13)
            in_check = 8 * 96 <= bit < 8 * 100
            assert found == (CAR if bit < 8 * 90 else Unfit.DAMAGED if in_check else Unfit.NOT_OURS)


def test_what_is_mended_to_something_else_is_found_out() -> None:
    """Three wrong bits in one column of the code: it mends to other data, and the check sum says so (ours; G6)."""
    body, frame = coded(CAR), the_response(CAR)
    columns = ((0, 4, 8), (1, 5, 9), (4, 8, 12), (16, 20, 24), (0, 8, 20))
    mended_wrongly = 0
    for block in range(0, 8 * CODED_BYTES, 32):
        for bits in columns:
            places = [block + bit for bit in bits]
            found = frames.decoded(flipped(body, *places))
            mended_wrongly += isinstance(found, VehicleData) and found != CAR
            read = frames.read_response(flipped(frame, *(8 * HEAD_BYTES + place for place in places)), 4, 13)
            assert read == CAR or isinstance(read, Unfit)
    assert mended_wrongly > 10


def test_the_check_sum_is_crc_32() -> None:
    assert frames.check_of(b"12345678", ord("9"), b"") == (0xCBF43926).to_bytes(4, "big")
    plain = frames.plain_bytes(CAR)
    assert frames.check_of(b"TA", 4, plain) == zlib.crc32(b"TA\x04" + plain).to_bytes(4, "big")


def test_at_any_rate_of_wrong_bits_none_is_read_wrongly() -> None:
    chance, frame = Random(3), the_response(CAR)
    for rate in (0.001, 0.01, 0.03):
        found = []
        for _ in range(1_500):
            wrong = [bit for bit in range(8 * 90, 8 * RESPONSE_BYTES) if chance.random() < rate]
            found.append(frames.read_response(flipped(frame, *wrong), 4, 13))
        assert all(each == CAR or isinstance(each, Unfit) for each in found)
        assert rate > 0.01 or CAR in found


def test_what_is_not_for_this_station_and_this_tram_is_refused() -> None:
    request, response = the_request(CAR), the_response(CAR)
    assert frames.read_response(response, 5, 13) == Unfit.NOT_OURS
    assert frames.read_response(response, 4, 14) == Unfit.OTHER_VEHICLE
    assert frames.read_request(request, 5, 13) == Unfit.NOT_OURS
    assert frames.read_request(request, 4, 14) == Unfit.OTHER_VEHICLE
    assert frames.read_request(request, 4, NOBODY) == Unfit.OTHER_VEHICLE
    assert frames.read_response(request, 4, 13) == Unfit.WRONG_LENGTH
    assert frames.read_request(response, 4, 13) == Unfit.WRONG_LENGTH
    assert frames.decoded(b"") == Unfit.WRONG_LENGTH


def test_a_tram_answers_in_the_slot_where_it_is_asked() -> None:
    others = [replace(CAR, vehicle=number) for number in (11, 12, 13, 14)]
    for slot, car in enumerate(others):
        assert frames.slot_of(the_request(*others), 4, car.vehicle) == slot


@pytest.mark.parametrize(
    "wrong",
    [
        replace(CAR, holds=True),
        replace(CAR, left=True),
        replace(CAR, stop=256),
        replace(CAR, stop=-1),
        replace(CAR, vehicle=256),
        replace(CAR, vehicle=-1),
        replace(CAR, line=256),
        replace(CAR, line=-1),
        replace(CAR, kind=256),
        replace(CAR, kind=-1),
        replace(CAR, leaves_at=256),
        replace(CAR, leaves_at=-1),
        replace(CAR, place_mm=MOST_MM + 1),
        replace(CAR, place_mm=-1),
        replace(CAR, time_ms=MOST_MM + 1),
        replace(CAR, time_ms=-1),
        replace(CAR, delay_ms=0x10000),
        replace(CAR, delay_ms=-1),
    ],
)
def test_what_makes_no_sense_is_not_sent(wrong: VehicleData) -> None:
    assert frames.coded(wrong) == Unfit.NO_SENSE
    assert frames.response(4, wrong) == Unfit.NO_SENSE
    assert frames.request(4, (CAR, wrong, EMPTY, EMPTY)) == Unfit.NO_SENSE
    assert frames.response(256, CAR) == frames.response(-1, CAR) == Unfit.NO_SENSE
    assert frames.request(256, (CAR,) * 4) == frames.request(-1, (CAR,) * 4) == Unfit.NO_SENSE


@pytest.mark.parametrize(
    ("place", "value"), [(3, 2), (4, 2), (5, 2), (6, 255), (7, 3), (8, 1), (22, 2), (6, 1), (5, 1)]
)
def test_what_nobody_writes_makes_no_sense(place: int, value: int) -> None:
    """Flags beyond 1, an unknown state of GPS, a stop beyond its byte; held and recovering; standing and gone."""
    plain = bytearray(frames.plain_bytes(CAR))
    plain[place] = value
    assert frames.read_plain(bytes(plain)) == Unfit.NO_SENSE


def test_what_a_tram_tells_and_is_told() -> None:
    assert frames.report_of(CAR) == Report(7, False, True, 20, 1_100_000_000_000)
    assert not frames.report_of(replace(CAR, gps=Gps.LOST)).stands
    assert frames.order_of(CAR) == Order(7, False, True, 1_100_000_000_000)


def crash(count: int, seed: int) -> dict[str, int]:
    """Read so many random frames: noise, noise behind a right head, and frames with random bits wrong; count them."""
    chance, counted = Random(seed), {"read": 0, "refused": 0}
    request, response = the_request(CAR, CAR), the_response(CAR)
    for number in range(count):
        kind = number % 4
        if kind == 0:
            frame = chance.randbytes(chance.choice((0, 1, RESPONSE_BYTES, RESPONSE_BYTES, REQUEST_BYTES)))
        elif kind == 1:
            frame = response[:HEAD_BYTES] + chance.randbytes(CODED_BYTES)
        elif kind == 2:
            frame = flipped(response, *(chance.randrange(8 * RESPONSE_BYTES) for _ in range(chance.randrange(12))))
        else:
            frame = request[:HEAD_BYTES] + chance.randbytes(CODED_BYTES) + request[HEAD_BYTES + CODED_BYTES :]
        found = (frames.read_request if kind == 3 else frames.read_response)(frame, 4, 13)
        counted["read" if isinstance(found, VehicleData) else "refused"] += 1
    return counted


def test_random_frames_crash_nothing() -> None:
    """A sample; the million is the slow test."""
    counted = crash(20_000, 1)
    assert sum(counted.values()) == 20_000
    assert counted["read"] > 2_000


@pytest.mark.slow
def test_a_million_random_frames_crash_nothing() -> None:
    assert sum(crash(1_000_000, 2).values()) == 1_000_000
