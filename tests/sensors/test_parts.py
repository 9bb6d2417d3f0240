"""Clocks, telegrams, tags, and the parameters as data."""

from __future__ import annotations

import numpy as np
import pytest

from models.sensors import tag_reader
from models.sensors.draws import choose
from models.sensors.faults import FAULTS, NEVER, PLACE, drawn, names, quiet
from models.sensors.tag_reader import STAND, STAND_ICODE1, frames, on_train, without_errors
from models.sensors.traces import Setup, traces
from tests.sensors.shared import CYCLES, some, track


def test_every_parameter_is_whole_and_drawn_within_its_range() -> None:
    values = choose(1, range(200), 0).values
    assert len(PLACE) == len(FAULTS) == len(set(names()))
    for fault in FAULTS:
        assert fault.least <= fault.most, fault.name
        assert fault.source, fault.name
        assert fault.bound, fault.name
        there = values[fault.name][values[fault.name] != fault.absent]
        assert ((fault.least <= there) & (there <= fault.most)).all(), fault.name
        assert fault.chance == 1 or (values[fault.name] == fault.absent).any(), fault.name


@pytest.mark.parametrize("name", [fault.name for fault in FAULTS if fault.beyond != fault.most])
def test_beyond_is_outside_the_range(name: str) -> None:
    declared = FAULTS[PLACE[name]]
    values = choose(1, range(50), 0, beyond=[name]).values[name]
    assert ((values <= declared.least) | (values >= declared.most)).all()
    assert np.unique(values).size > 10


def test_a_parameter_set_outright_is_that_and_leaves_the_others() -> None:
    uniforms = np.full((2, len(FAULTS), 2), 0.25)
    plain, fixed = drawn(uniforms), drawn(uniforms, present={"loss": 0.5})
    assert fixed["loss"].tolist() == [0.5, 0.5]
    assert all(np.array_equal(plain[name], fixed[name]) for name in names() if name != "loss")


def test_telegrams_come_late_get_lost_and_never_from_the_future() -> None:
    sensors = some().sensors
    cycles = np.arange(CYCLES)
    assert (sensors.tail_source < cycles).all()
    assert (np.diff(sensors.tail_source, axis=1) >= 0).all()
    assert np.array_equal(sensors.tail_arrived[:, 1:], np.diff(sensors.tail_source, axis=1) > 0)
    assert 0.8 < sensors.tail_arrived.mean() < 1
    heard = sensors.tail_source >= 0
    lag = 100 * (cycles - sensors.tail_source)
    assert np.abs(sensors.tail_age_ms - lag)[heard].max() <= 2 * (5 + 2 + 20 * 0.2) + 1


def test_nothing_arrives_in_an_outage_or_when_all_is_lost() -> None:
    out = quiet() | {"radio_out_at_s": 20.0, "radio_out_s": 5.0}
    sensors = traces(Setup(track(), 400, present=out), 1, [0]).sensors
    assert not sensors.tail_arrived[0, 200:249].any()
    assert sensors.tail_arrived[0, 50:199].all()
    assert sensors.tail_arrived[0, 255:].all()


def test_a_clock_in_an_outage_drifts_and_says_so() -> None:
    out = quiet() | {"clock_out_at_s": 10.0, "clock_out_s": 100.0, "clock_drift_ppm": 200.0}
    sensors = traces(Setup(track(), 1_400, present=out), 1, [0]).sensors
    assert not sensors.clocks_synchronous[0, 100:1_100].any()
    assert sensors.clocks_synchronous[0, :100].all()
    assert sensors.tail_age_ms[0, 1_090] - sensors.tail_age_ms[0, 90] == pytest.approx(40, abs=3)


@pytest.mark.parametrize("name", ["inertial_nan_at_s", "tachometer_silent_at_s"])
def test_a_sensor_that_says_nothing_is_not_valid(name: str) -> None:
    sensors = traces(Setup(track(), 600, present=quiet() | {name: 30.0, name.replace("at_", ""): 5.0}), 1, [0]).sensors
    column = sensors.force_mm_s2 if "inertial" in name else sensors.wheel_way_mm
    assert not column.valid[0, 300:350].any()
    assert column.valid[0, :300].all()
    assert column.valid[0, 351:].all()


def test_a_stuck_tachometer_repeats_itself_and_goes_on_counting_from_there() -> None:
    stuck = quiet() | {"traction_m_s2": 0.9, "tachometer_stuck_at_s": 30.0, "tachometer_stuck_s": 5.0}
    sensors = traces(Setup(track(), 600, present=stuck), 1, [0]).sensors
    way = sensors.wheel_way_mm.numbers[0]
    assert (way[299:350] == way[299]).all()
    assert sensors.wheel_way_mm.valid.all()
    assert 0 < way[350] - way[349] < 5_000
    assert np.diff(way).min() >= 0


def test_the_reader_receives_one_page_up_to_the_papers_speeds() -> None:
    worst = np.array([1.0])
    for reader, fastest in ((STAND, 100), (STAND_ICODE1, 160)):
        assert frames(reader, np.array([fastest / 3.6]), worst) == 1
        assert frames(reader, np.array([(fastest + 1) / 3.6]), worst) == 0
    assert STAND.processing_ms > 10 * STAND.air_ms


def test_fewer_frames_come_faster_and_under_a_train_and_many_at_a_standstill() -> None:
    speed = np.linspace(0, 60, 200)
    stand, train = (frames(reader, speed, np.zeros(200)) for reader in (STAND, on_train(STAND)))
    assert (np.diff(stand) <= 0).all()
    assert (train <= stand).all()
    assert stand[0] == 1_000


@pytest.mark.parametrize("errors", [0.0, 0.05, 0.5, 0.9])
def test_frames_with_errors_are_binomial(errors: float) -> None:
    random = np.random.default_rng(1)
    good = without_errors(np.full(20_000, 5), errors, random.random(20_000))
    assert good.mean() == pytest.approx(5 * (1 - errors), abs=0.05)
    assert ((good >= 0) & (good <= 5)).all()


def test_tags_are_passed_in_order_and_where_they_lie() -> None:
    made, tags = some(), track().tags_m
    cycle, head = made.reads.cycle, made.truth.head_m
    passed = cycle >= 0
    assert passed.any()
    rows, which = np.nonzero(passed)
    assert (head[rows, cycle[passed]] >= tags[which]).all()
    assert (head[rows, cycle[passed] - 1] < tags[which]).all()
    assert (made.reads.frames[~passed] == 0).all()
    assert np.isnan(tag_reader.passing_s(np.array([-1, 3], np.int32))).tolist() == [True, False]


def test_quiet_means_no_fault_at_all() -> None:
    values = quiet()
    assert all(value == NEVER for name, value in values.items() if name.endswith("_at_s"))
    assert values["head_bias_m_s2"] == 0
