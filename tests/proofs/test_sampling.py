"""What `--sample N` tries: always the same, and a name that comes changes at most one of them."""

from __future__ import annotations

from random import Random

from hypothesis import given
from hypothesis import strategies as st

from proofs.mutants import joints, trying
from proofs.mutants.targets import mutants
from proofs.sampling import sampled

NAMES = st.lists(st.text(), unique=True)


@given(NAMES, st.integers(1, 30))
def test_a_sample_is_of_so_many_in_their_order(names: list[str], count: int) -> None:
    drawn = sampled(names, count)
    assert len(drawn) == min(count, len(names))
    assert drawn == [name for name in names if name in drawn]


@given(NAMES)
def test_without_a_count_all_are_tried(names: list[str]) -> None:
    assert sampled(names, None) == names


@given(NAMES.filter(len), st.integers(1, 30), st.data())
def test_a_name_that_comes_drives_out_at_most_one(names: list[str], count: int, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(names) - 1))
    before = sampled(names[:at] + names[at + 1 :], count)
    after = sampled(names, count)
    assert set(after) - set(before) <= {names[at]}
    assert len(set(before) - set(after)) <= 1


@given(NAMES, st.integers(1, 30), st.randoms())
def test_the_order_of_the_names_changes_nothing_that_is_drawn(names: list[str], count: int, by: Random) -> None:
    drawn = set(sampled(names, count))
    by.shuffle(names)
    assert set(sampled(names, count)) == drawn


def test_every_part_of_the_kernel_has_its_share() -> None:
    drawn = trying.chosen("", 100)
    folders = {name.split(".")[1] for name in drawn}
    assert {"onboard", "alarm", "crossing", "tram"} <= folders
    assert len(drawn) == 100 < len(mutants())
    assert len(joints.chosen("", 12)) == 12
