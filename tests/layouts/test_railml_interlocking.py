"""railML's interlocking beside its routes: overlaps, release groups, declared conflicts."""

from __future__ import annotations

from itertools import combinations

import pytest

from models.layouts import BadInput, Imported, check, load_text
from models.layouts.conflict_pairs import Conflicts
from models.layouts.native import import_native
from models.layouts.railml.overlaps import FITS, OF_A_ROUTE
from tests.independent.layouts.dangerous_railml import CROSSES, CROSSING, FOULED, SPOTS, railml
from tests.layouts.railml_made import railml_of
from tests.layouts.stations import plain_station, railjson_of

RAILML = railml_of(railjson_of(plain_station()))
SECTIONS = """<tvdSections>
  <tvdSection id="ab"><hasDemarcatingTraindetector ref="a"/><hasDemarcatingTraindetector ref="b"/></tvdSection>
  <tvdSection id="P1"><hasDemarcatingTraindetector ref="b"/><hasDemarcatingTraindetector ref="c"/>
    <hasDemarcatingTraindetector ref="e"/></tvdSection>
  <tvdSection id="Q1"><hasDemarcatingTraindetector ref="d"/><hasDemarcatingTraindetector ref="f"/>
    <hasDemarcatingTraindetector ref="g"/></tvdSection>
  <tvdSection id="gh"><hasDemarcatingTraindetector ref="g"/><hasDemarcatingTraindetector ref="h"/></tvdSection>
</tvdSections>"""


def told(*pieces: str, text: str = RAILML) -> Imported:
    return load_text("file", text.replace("<assetsForIL>", f"<assetsForIL>{SECTIONS}{''.join(pieces)}"))


def overlap(inside: str, of: str = '<activeForApproachRoute ref="a-d"/>', more: str = "") -> str:
    return f'<overlaps><overlap id="o" {more}>{of}{inside}</overlap></overlaps>'


def native_with_overlap(end: str) -> Imported:
    data = plain_station()
    data["routes"]["a-d"] |= {"overlap_to": end, "points": {"P": "normal", "Q": "normal"}, "release_at": []}
    return import_native("file", data, ("T1",))


@pytest.mark.parametrize(
    ("piece", "end"),
    [
        (overlap('<isLimitedBy ref="g"/>'), "g"),
        (overlap('<isLimitedBy ref="h"/>'), "h"),
        (overlap('<hasTvdSection ref="Q1"/>'), "g"),
        (overlap('<hasTvdSection ref="Q1"/><hasTvdSection ref="gh"/>'), "h"),
        (overlap("", more='length="150"'), "g"),
        (overlap("", more='length="200.5"'), "h"),
        (overlap('<hasTvdSection ref="gh"/>'), "h"),
        (overlap("", more='length="2100"'), "east"),
        (overlap('<isLimitedBy ref="g"/>', '<relatedToTrackAsset ref="d-normal"/>'), "g"),
    ],
)
def test_an_overlap_is_followed_to_its_end(piece: str, end: str) -> None:
    imported, native = told(piece), native_with_overlap(end)
    for field in ("claims", "overlap", "way", "released_with", "released_after", "first_tag"):
        assert getattr(imported.layout, field)["a-d"] == getattr(native.layout, field)["a-d"], field
    assert imported.layout.needs["a-d"] == {"P": "left", "Q": "left"}  # type: ignore[index]
    assert not imported.layout.overlap["a-f"]  # type: ignore[index]
    assert check(imported).verdict == "holds"


@pytest.mark.parametrize(
    ("piece", "said"),
    [
        (overlap(""), "overlap 'o': says neither what limits it, nor its sections, nor its length"),
        (overlap('<isLimitedBy ref="a"/>'), "overlap 'o': no ways lead from 'd'"),
        (overlap('<isLimitedBy ref="g"/>', '<activeForApproachRoute ref="P"/>'), "'o': is told for 'P'"),
        (overlap('<hasTvdSection ref="ab"/><hasTvdSection ref="Q1"/>'), "overlap 'o': no ways lead from 'd'"),
        (overlap('<isLimitedBy ref="nix"/>'), "refers to 'nix', which is not there"),
        (overlap("", more='length="-5"'), "overlap 'o': length is '-5'"),
        (
            overlap(
                '<isLimitedBy ref="g"/><requiresSwitchInPosition inPosition="right"><refersToSwitch ref="Q"/>'
                "</requiresSwitchInPosition>"
            ),
            "overlap 'o': no ways lead from 'd'",
        ),
    ],
)
def test_an_overlap_that_leads_nowhere_is_refused(piece: str, said: str) -> None:
    with pytest.raises(BadInput) as refused:
        told(piece)
    assert said in str(refused.value)


def test_an_overlap_that_is_told_longer_than_the_track_is_a_violation() -> None:
    for length, found in (("2100", []), ("2100.001", [("a-d", "o", "east")]), ("99000", [("a-d", "o", "east")])):
        result = check(told(overlap("", more=f'length="{length}"')))
        assert [v.elements for v in result.violations if v.axiom == FITS] == found
        assert (result.verdict == "holds") == (not found)


@pytest.mark.parametrize("end", ['<isLimitedBy ref="g"/>', '<hasTvdSection ref="Q1"/>'])
def test_an_overlap_is_as_long_as_the_way_to_what_ends_it(end: str) -> None:
    for length, found in (("201", []), ("201.001", [("a-d", "o", "g")]), ("99000", [("a-d", "o", "g")])):
        result = check(told(overlap(end, more=f'length="{length}"')))
        assert [v.elements for v in result.violations if v.axiom == FITS] == found


def test_an_overlap_is_that_of_the_routes_that_end_where_its_asset_stands() -> None:
    limit = '<isLimitedBy ref="g"/>'
    for asset, speaks in (("d-normal", True), ("d", True), ("a-normal", False), ("d-reverse", False)):
        imported = told(overlap(limit if speaks else "", f'<relatedToTrackAsset ref="{asset}"/>'))
        assert bool(imported.layout.overlap["a-d"]) == speaks  # type: ignore[index]
        odd = [each.elements for each in check(imported).violations if each.axiom == OF_A_ROUTE]
        assert odd == ([] if speaks else [("o", asset)])


def test_an_overlap_ends_at_a_signal_that_no_route_uses() -> None:
    signal = '<signalIS id="limit"><spotLocation netElementRef="x" intrinsicCoord="0.5"/></signalIS>'
    text = RAILML.replace("</functionalInfrastructure>", f"{signal}</functionalInfrastructure>")
    assert "B:g+h" in told(text=text).layout.blocks
    imported = told(overlap('<isLimitedBy ref="limit"/>'), text=text)
    assert imported.layout.overlap["a-d"] == {"B:d+f+g", "B:g+limit"}  # type: ignore[index]
    assert check(imported).verdict == "holds"


def test_a_detector_that_fouls_a_crossing_joins_the_blocks_beside_it() -> None:
    text = railml(CROSSING, SPOTS, CROSSES.format(""), FOULED.format("A tags"))
    block, before = "B:A tags+B tags+C tags+D tags", "B:A tags"
    assert before in load_text("crossing.railml", text).layout.fouls[block]  # type: ignore[index]


def test_of_several_overlaps_the_first_is_taken_and_timers_are_not() -> None:
    piece = overlap('<isLimitedBy ref="g"/><overlapRelease id="r"/>').replace("</overlaps>", "")
    other = overlap('<isLimitedBy ref="h"/>').replace("<overlaps>", "").replace('id="o"', 'id="o2"')
    imported = told(piece + other)
    assert imported.layout.overlap["a-d"] == {"B:d+f+g"}  # type: ignore[index]
    texts = [remark.text for remark in imported.remarks]
    assert "route 'a-d' has 2 overlaps to choose from: it always claims the first, 'o'" in texts
    assert any("overlapRelease" in text for text in texts)


@pytest.mark.parametrize(
    ("groups", "released"),
    [
        ((("ab",), ("P1",)), {"B:a+b": "B:a+b", "B:b+c+e": "B:b+c+e"}),
        ((("ab", "P1"),), {"B:a+b": "B:b+c+e", "B:b+c+e": "B:b+c+e"}),
    ],
)
def test_a_route_is_released_by_its_groups(groups: tuple[tuple[str, ...], ...], released: dict[str, str]) -> None:
    listed = ["".join(f'<hasTvdSection ref="{section}"/>' for section in group) for group in groups]
    made = [f'<routeReleaseGroupRear id="g{n}">{each}</routeReleaseGroupRear>' for n, each in enumerate(listed)]
    named = "".join(f'<hasReleaseGroup ref="g{n}"/>' for n in range(len(groups)))
    imported = told(*made, text=RAILML.replace('<route id="a-d">', f'<route id="a-d">{named}'))
    after = imported.layout.released_after["a-d"]  # type: ignore[index]
    assert {block: after[block] for block in released} == released  # type: ignore[index]


def test_delays_of_sections_are_told_not_to_be_kept() -> None:
    text = RAILML.replace("<assetsForIL>", f"<assetsForIL>{SECTIONS}").replace(
        '<tvdSection id="ab">', '<tvdSection id="ab" partialRouteReleaseDelay="PT4S">'
    )
    imported = load_text("file", text)
    assert ("ab",) in {remark.elements for remark in imported.remarks}
    assert imported.layout.released_after["a-d"]["B:a+b"] == "B:a+b"  # type: ignore[index]


# ---- declared conflicts


def conflicting(pairs: list[tuple[str, str]]) -> str:
    told = [f'<refersToRoute ref="{one}"/><conflictsWithRoute ref="{other}"/>' for one, other in pairs]
    rows = [f'<conflictingRoute id="k{n}">{each}</conflictingRoute>' for n, each in enumerate(told)]
    return f"<conflictingRoutes>{''.join(rows)}</conflictingRoutes>"


FOLLOWING = [(str(one), str(other)) for one, other in Conflicts(load_text("file", RAILML).layout).pairs()]
APART = sorted(set(combinations(sorted(map(str, load_text("file", RAILML).layout.routes)), 2)) - set(FOLLOWING))


def test_conflicts_that_follow_are_declared_without_a_word() -> None:
    imported = told(conflicting(FOLLOWING))
    assert imported.remarks == told().remarks
    assert check(imported).verdict == "holds"


def test_a_conflict_that_is_not_declared_is_a_remark() -> None:
    imported = told(conflicting(FOLLOWING[1:]))
    assert [remark.elements for remark in imported.remarks if "not declared" in remark.text] == [FOLLOWING[0]]
    assert check(imported).verdict == "holds"


@pytest.mark.parametrize("pair", APART[:6])
def test_a_declared_conflict_that_nothing_keeps_apart_is_a_violation(pair: tuple[str, str]) -> None:
    result = check(told(conflicting([*FOLLOWING, (pair[1], pair[0])])))
    assert [(violation.axiom, violation.elements) for violation in result.violations] == [
        ("declared conflicts follow", pair)
    ]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('<conflictsWithRoute ref="a-f"/>', '<conflictsWithRoute ref="P"/>', "names 'P', which is no route"),
        ('<conflictsWithRoute ref="a-f"/>', "", "does not say which route conflicts with which"),
    ],
)
def test_a_conflict_with_no_route_is_refused(old: str, new: str, said: str) -> None:
    piece = conflicting([("a-d", "a-f")])
    assert old in piece
    with pytest.raises(BadInput, match=said):
        told(piece.replace(old, new))
