"""What a railML or RailJSON file tells beside what is read: named by id, and a contradiction is a violation."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from kernel.names import Block
from models.layouts import BadInput, Imported, check, load, load_text
from models.layouts.clearance import RULE as CLEAR
from models.layouts.railml.sections import MATCH
from models.layouts.railml.switches import AGREE, FOULS, ONE_MARKER
from models.layouts.railml.unread import NOT_READ
from tests.layouts.railml_2_made import railml_2_of
from tests.layouts.railml_made import railml_of
from tests.layouts.stations import SHARED, needs_shared, plain_station, railjson_of

DATA = railjson_of(plain_station())
RAILML = railml_of(DATA)


def told(functional: str = "", assets: str = "", text: str = RAILML) -> Imported:
    """The document with more on its track, and more in its interlocking."""
    text = text.replace("</functionalInfrastructure>", f"{functional}</functionalInfrastructure>")
    return load_text("file", text.replace("<assetsForIL>", f"<assetsForIL>{assets}"))


def unread(imported: Imported) -> set[str]:
    found = [rest.instances for rest in check(imported).rests if rest.kind == "unread" and not rest.declared]
    return {element for instances in found for instance in instances for element in instance}


def elements_of(imported: Imported, rule: str) -> list[tuple[str, ...]]:
    return [violation.elements for violation in check(imported).violations if violation.axiom == rule]


@pytest.mark.parametrize("kind", sorted(NOT_READ))
def test_each_kind_that_is_not_read_is_told_by_id_and_no_verdict_is_silent_on_it(kind: str) -> None:
    imported = told(f'<{kind} id="odd"/><{kind}/>')
    assert {"odd"} < unread(imported)
    assert len(unread(imported)) == 2
    assert check(imported).verdict == "holds"
    assert check(imported, strict=True).verdict == "does not hold"


def test_a_derailer_of_railml_2_is_told() -> None:
    text = railml_2_of(DATA, "2.4")
    assert unread(load_text("file", text)) == set()
    at = text.index("</track>")
    imported = load_text("file", f'{text[:at]}<ocsElements><derailer id="der" pos="5"/></ocsElements>{text[at:]}')
    assert unread(imported) == {"der"}


def test_what_stands_in_another_namespace_is_no_railml() -> None:
    plain, spot = told(), '<o:spotLocation netElementRef="w" intrinsicCoord="0.5" applicationDirection="both"/>'
    ghost = f'<o:trainDetectionElement xmlns:o="urn:o" id="ghost">{spot}</o:trainDetectionElement>'
    found = told(ghost)
    assert found.layout == plain.layout
    assert unread(found) == {"ghost"}
    taken = told(ghost.replace("ghost", "a"))
    assert taken.layout == plain.layout
    real = told(ghost.replace("o:", "").replace(' xmlns:o="urn:o"', ""))
    assert real.layout != plain.layout


@pytest.mark.parametrize(("pos", "at_odds"), [("400.0", False), ("400.9", False), ("402.0", True), ("1.0", True)])
def test_a_place_that_is_told_twice_is_one_place(pos: str, at_odds: bool) -> None:
    old = 'intrinsicCoord="0.400000000"'
    assert old in RAILML
    imported = told(text=RAILML.replace(old, f'{old} pos="{pos}"'))
    named = {element for elements in elements_of(imported, "an element lies in one place") for element in elements}
    assert ("a" in named) == at_odds


def switch_il(left: str, right: str, more: str = "") -> str:
    branches = f'<branchLeft ref="{left}"/><branchRight ref="{right}"/>'
    return f'<switchesIL><switchIL id="il"><refersTo ref="P"/>{branches}{more}</switchIL></switchesIL>'


@pytest.mark.parametrize(
    ("left", "right", "wrong"),
    [("t1", "t2", 0), ("t2", "t1", 2), ("t1", "t1", 1), ("w", "t2", 1), ("trk", "t2", 0), ("t1", "trk", 1)],
)
def test_the_branches_of_a_switch_are_those_of_its_track(left: str, right: str, wrong: int) -> None:
    track = '<track id="trk"><linearLocation><associatedNetElement netElementRef="t1"/></linearLocation></track>'
    imported = told(track, switch_il(left, right))
    assert elements_of(imported, AGREE) == [("P", "il")] * wrong
    assert unread(imported) == set()


def test_a_branch_that_cannot_be_compared_is_told() -> None:
    assert unread(told("", switch_il("a", "t2"))) == {"il", "P"}
    with pytest.raises(BadInput, match="refers to 'nix', which is not there"):
        told("", switch_il("nix", "t2"))


def marker(track: str, share: str) -> str:
    where = f'netElementRef="{track}" intrinsicCoord="{share}" applicationDirection="both"'
    return f'<signalIS id="mark"><spotLocation {where}/></signalIS>'


@pytest.mark.parametrize(("share", "clear_mm"), [("0.05", 50_000), ("0.099", 99_000), ("0.2", 200_000)])
def test_a_clearance_marker_tells_where_a_leg_is_clear(share: str, clear_mm: int) -> None:
    imported = told(marker("t1", share), switch_il("t1", "t2", '<hasGaugeClearanceMarker ref="mark"/>'))
    assert [leg.clear_mm for leg in imported.legs if leg.clear_mm is not None] == [clear_mm]
    assert elements_of(imported, CLEAR) == ([("P", "c")] if clear_mm > 100_000 else [])


@pytest.mark.parametrize(("near", "far"), [("0.05", "0.07"), ("0.07", "0.05"), ("0.05", "0.05")])
def test_a_leg_that_is_marked_in_two_places_is_a_violation_and_clear_from_the_farther(near: str, far: str) -> None:
    markers = "".join(marker("t1", share).replace('"mark"', f'"{name}"') for name, share in (("m", near), ("n", far)))
    switch = switch_il("t1", "t2", '<hasGaugeClearanceMarker ref="m"/><hasGaugeClearanceMarker ref="n"/>')
    imported = told(markers, switch)
    assert [leg.clear_mm for leg in imported.legs if leg.clear_mm] == [round(float(max(near, far)) * 1_000_000)]
    assert elements_of(imported, ONE_MARKER) == ([("P", "n")] if near != far else [])


def test_what_is_not_read_and_has_no_id_goes_by_that_of_what_it_stands_in() -> None:
    assert unread(told("", switch_il("t1", "t2", '<relatedMovableElement ref="Q"/>'))) == {"il"}


def test_a_clearance_marker_on_no_leg_is_told() -> None:
    imported = told(marker("z", "0.5"), switch_il("t1", "t2", '<hasGaugeClearanceMarker ref="mark"/>'))
    assert unread(imported) == {"P", "mark"}
    assert all(leg.clear_mm is None for leg in imported.legs)


def test_the_blocks_behind_detectors_that_foul_one_switch_on_both_legs_foul_each_other() -> None:
    both = "".join(f'<hasFoulingTrainDetectors ref="{detector}"/>' for detector in "ceb")
    fouls = told("", switch_il("t1", "t2", both)).layout.fouls
    assert fouls[Block("B:c+d")] == {Block("B:b+c+e"), Block("B:e+f")}
    assert fouls[Block("B:e+f")] == {Block("B:b+c+e"), Block("B:c+d")}
    assert fouls[Block("B:a+b")] == {Block("B:b+c+e")}


def test_a_detector_that_fouls_a_switch_makes_the_blocks_beside_it_foul_each_other() -> None:
    near = RAILML.replace('netElementRef="t1" intrinsicCoord="0.100000000"', 'netElementRef="t1" intrinsicCoord="0.01"')
    assert elements_of(told(text=near), CLEAR) == [("P", "c")]
    imported = told("", switch_il("t1", "t2", '<hasFoulingTrainDetectors ref="c"/>'), near)
    assert elements_of(imported, CLEAR) == []
    assert imported.layout.fouls == {
        Block("B:b+c+e"): frozenset({Block("B:c+d")}),
        Block("B:c+d"): frozenset({Block("B:b+c+e")}),
    }
    assert check(imported).verdict == "holds"
    assert elements_of(told("", switch_il("t1", "t2", '<hasFoulingTrainDetectors ref="h"/>')), FOULS) == [("P", "h")]


SECTIONS = """<tvdSections>
  <tvdSection id="ab"><hasDemarcatingTraindetector ref="a"/><hasDemarcatingTraindetector ref="b"/></tvdSection>
  <tvdSection id="cd"><hasDemarcatingTraindetector ref="c"/><hasDemarcatingTraindetector ref="d"/></tvdSection>
  <tvdSection id="gh"><hasDemarcatingTraindetector ref="g"/><hasDemarcatingTraindetector ref="h"/></tvdSection>
</tvdSections>"""


@pytest.mark.parametrize(
    ("named", "odd"),
    [(("ab", "cd"), None), (("ab", "gh"), {"cd", "gh"}), (("ab",), {"cd"}), (("ab", "cd", "gh"), {"gh"}), ((), None)],
)
def test_a_route_that_names_other_sections_than_its_own_contradicts_itself(
    named: tuple[str, ...], odd: set[str] | None
) -> None:
    listed = "".join(f'<hasTvdSection ref="{each}"/>' for each in named)
    imported = told("", SECTIONS, RAILML.replace('<route id="a-d">', f'<route id="a-d">{listed}'))
    found = [set(elements) for elements in elements_of(imported, MATCH)]
    assert found == ([] if odd is None else [{"a-d", *odd}])


def test_a_section_that_no_piece_of_track_is_is_a_violation() -> None:
    section = '<tvdSection id="ah"><hasDemarcatingTraindetector ref="a"/><hasDemarcatingTraindetector ref="h"/>'
    assert elements_of(told("", f"{section}</tvdSection>"), MATCH) == [("ah", "a", "h")]


def test_lists_of_railjson_that_are_not_read_are_told_by_id() -> None:
    more = {"speed_sections": [{"id": "slow"}, {}], "derailers": [{"id": "der"}], "signals": [{"id": "s"}], "tags": []}
    assert unread(load_text("file", json.dumps(DATA | more))) == {"slow", "speed_sections[1]", "der"}


CRAFTED = SHARED.parent / "attacks" / "layouts"
TRUE_OF_IT = {
    "r_ilswap.railml": ("il_swi9", True),
    "r_section.railml": ("tvd80", True),
    "r_pos.railml": ("tde78", True),
    "r_close.railml": ("swi72", True),
    "r_derailer.railml": ("der1", False),
    "r_ns.railml": ("ghost", False),
    "frog.toml": ("P", True),
    "atswitch.json": ("D1", True),
    "tiny.toml": ("B", True),
    "samejoint.json": ("D2", True),
    "km.json": ("T1", True),
    "overflow.toml": ("A", True),
    "typojoint.toml": ("Joint", True),
    "uni.toml": ("W ", True),
    "joined.toml": ("sand drag", False),
    "tagcol.toml": ("k", False),
}


@needs_shared
@pytest.mark.parametrize("name", sorted(TRUE_OF_IT))
def test_a_crafted_file_gets_a_verdict_that_is_true_of_it(name: str) -> None:
    file, (element, is_wrong) = CRAFTED / name, TRUE_OF_IT[name]
    if not file.exists():
        pytest.skip(f"{file} is absent")
    result = check(load(file))
    named = {each for violation in result.violations for each in violation.elements}
    resting = {each for rest in result.rests if not rest.declared for instance in rest.instances for each in instance}
    remarked = {each for remark in result.remarks for each in remark.elements}
    assert (result.verdict == "does not hold") == is_wrong
    assert element in (named if is_wrong else resting | remarked)


@needs_shared
def test_a_crafted_name_of_two_lines_is_refused() -> None:
    file = Path(CRAFTED / "dup.toml")
    if file.exists():
        with pytest.raises(BadInput, match="not usable as a name"):
            load(file)
