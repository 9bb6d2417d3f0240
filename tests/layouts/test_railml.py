"""railML: the same network means the same layout, and what is wrong in a file is said of the element."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

import heisoku
from models.exit_codes import BAD_INPUT, HOLDS
from models.layouts import BadInput, Imported, as_json, check, load, load_text
from tests.layouts.railml_made import POSITIONS, railml_of
from tests.layouts.stations import SHARED, needs_shared, plain_station, railjson_of

RAILJSON = railjson_of(plain_station())
RAILML = railml_of(RAILJSON)
PUBLISHED = {"gicsafe-1": 14, "gicsafe-2": 5, "gicsafe-5": 16}


def facts(imported: Imported, positions: dict[str, str]) -> dict[str, Any]:
    """What a layout says of each route; positions by another name."""
    layout = imported.layout
    return {
        str(route): (
            layout.start[route],
            sorted(layout.covers[route]),
            layout.destination[route],
            sorted((point, positions.get(lies, lies)) for point, lies in layout.needs[route].items()),
        )
        for route in layout.routes
    }


def test_the_same_network_in_railml_is_the_same_layout() -> None:
    ours = load_text("railml", RAILML)
    theirs = load_text("railjson", json.dumps(RAILJSON))
    assert facts(ours, {}) == facts(theirs, POSITIONS)
    assert ours.layout.blocks == theirs.layout.blocks
    assert ours.layout.fouls == theirs.layout.fouls
    assert ours.layout.tag_after == theirs.layout.tag_after
    assert check(ours).verdict == "holds"


@pytest.mark.parametrize("version", ["3.1", "3.2", "3.3"])
def test_points_that_no_route_names_follow_from_its_only_way(version: str) -> None:
    untold = load_text("railml", railml_of(RAILJSON, version, given=False))
    assert facts(untold, {}) == facts(load_text("railml", RAILML), {})


def test_track_is_that_of_every_level_micro_and_of_no_other() -> None:
    names = [track["id"] for track in RAILJSON["track_sections"]]

    def levels(*told: tuple[str, list[str]]) -> str:
        listed = [(word, "".join(f'<networkResource ref="{each}"/>' for each in each_of)) for word, each_of in told]
        made = "".join(f'<network><level descriptionLevel="{word}">{refs}</level></network>' for word, refs in listed)
        macro = '<netElement id="line"/><netElement id="area"/>'
        return RAILML.replace("<netElements>", f"<networks>{made}</networks><netElements>{macro}", 1)

    two = load_text("railml", levels(("Macro", ["line"]), ("Micro", names[:2]), ("Micro", names[2:])))
    assert facts(two, {}) == facts(load_text("railml", RAILML), {})
    assert [remark.elements for remark in two.remarks if remark.rests == "unread"] == [("area",)]
    with pytest.raises(BadInput, match="which is on no level Micro"):
        load_text("railml", levels(("Micro", names[:2]), ("Meso", names[2:])))


DRAWN = """<netElement id="w" length="1000.0"><geometricCoordinate x="0" y="0"/><geometricCoordinate x="900" y="0"/>
</netElement>"""


@pytest.mark.parametrize(
    ("pattern", "into", "elements"),
    [
        (r'(?s)<switchIS id="P".*?</switchIS>', "", {"P_A_B1"}),
        (r'<netElement id="w" length="1000.0"/>', DRAWN, {"w"}),
        (r'(?s)(<route id="a-d">.*?<refersTo ref=")d-normal"', r'\1d-reverse"', {"a-d", "d-reverse"}),
    ],
)
def test_a_strict_verdict_does_not_rest_on_what_the_import_chose(pattern: str, into: str, elements: set[str]) -> None:
    text, count = re.subn(pattern, into, railml_of(RAILJSON, given=False), count=1)
    imported = load_text("railml", text)
    assert count == 1
    assert {each for remark in imported.remarks if remark.rests == "derived" for each in remark.elements} == elements
    assert check(imported).verdict == "holds"
    refused = check(imported, strict=True).violations
    assert elements <= {each for violation in refused for each in violation.elements}


def test_a_mark_at_a_joint_may_be_told_at_both_ends_that_meet_there() -> None:
    ends = [("x", "1"), ("z", "0"), ("w", "0")]
    told = [f'<spotLocation netElementRef="{track}" intrinsicCoord="{share}"/>' for track, share in ends]
    for spots, odd in (("".join(told[:2]), []), ("".join(told[1:]), [("seam",)])):
        seam = f'<trainDetectionElement id="seam">{spots}</trainDetectionElement></functionalInfrastructure>'
        result = check(load_text("railml", RAILML.replace("</functionalInfrastructure>", seam)))
        assert [v.elements for v in result.violations if v.axiom == "an element lies in one place"] == odd


@pytest.mark.parametrize(
    ("part", "length", "long"),
    [
        ("", 'value="1009"', True),
        ("", 'value="1011"', False),
        ("", 'value="300" type="operational"', True),
        ('intrinsicCoordBegin="0.1"', 'value="300"', True),
        ('intrinsicCoordBegin="0" intrinsicCoordEnd="1"', 'value="300"', False),
    ],
)
def test_a_net_element_is_as_long_as_the_track_that_is_all_of_it(part: str, length: str, long: bool) -> None:
    location = f'<linearLocation><associatedNetElement netElementRef="z" {part}/></linearLocation>'
    track = f'<track id="T">{location}<length {length}/></track></functionalInfrastructure>'
    result = check(load_text("railml", RAILML.replace("</functionalInfrastructure>", track)))
    assert [v.elements for v in result.violations] == ([] if long else [("z", "T")])


def test_a_branch_that_is_told_often_is_one_branch() -> None:
    branch = next(line for line in RAILML.splitlines(keepends=True) if "<leftBranch" in line)
    assert facts(load_text("railml", RAILML.replace(branch, branch * 12)), {}) == facts(load_text("railml", RAILML), {})


def test_without_routes_they_are_derived_from_signal_to_signal() -> None:
    derived = load_text("railml", railml_of(RAILJSON, routes=False))
    assert any("derived" in remark.text for remark in derived.remarks)
    assert check(derived).verdict == "holds"
    names = {str(route) for route in derived.layout.routes}
    assert {"a - b", "b - c", "b - e", "d - g", "f - g", "h - g", "g - d"} <= names
    assert {"g - h from Q left", "g - h from Q right"} <= names


CHANGES: tuple[tuple[str, str, str], ...] = (
    ('version="3.1"', 'version="1.1"', "railML 1.1, which is not read"),
    ('version="3.1"', 'version="2.4"', "has no track with a trackTopology"),
    ('positionOnB="0"', 'positionOnB="0.5"', "netRelation 'P_A_B1': positionOnB is 0.5: no end"),
    ('<elementA ref="w"', '<elementA ref="u"', "refers to 'u', which is not there"),
    ('length="1000.0"', 'length="long"', "netElement 'w': length is 'long', not a number"),
    ('length="1000.0"', "", "netElement 'w': has no length"),
    ('netRelationRef="P_A_B1"', 'netRelationRef="none"', "switchIS 'P': its left branch refers to 'none'"),
    ('netRelationRef="P_A_B1"', 'netRelationRef="Q_A_B1"', "switchIS 'P'"),
    ('navigability="None"', 'navigability="Both"', "switchIS 'P': 3 ends of track meet here, and 3 ways"),
    ('intrinsicCoord="0.400000000"', 'intrinsicCoord="1.4"', "spotLocation 'a_spot': intrinsicCoord is '1.4'"),
    (
        'netElementRef="w"',
        'netElementRef="v"',
        "Element 'a': lies on net element 'v', which is not there",
    ),
    ('<refersTo ref="d-normal"', '<refersTo ref="nobody"', "refers to 'nobody', which is not there"),
    ('<refersTo ref="d-normal"', '<refersTo ref="west"', "route 'a-d': no way leads from 'a-normal' to 'west'"),
    ('inPosition="left"', 'inPosition="up"', "'P' is no point that can lie 'up'"),
    ('inPosition="left"', 'inPosition="right"', "route 'a-d': no way leads"),
    ('id="P"', 'id="w"', "switchIS 'w': this id is taken by a netElement"),
    ('<elementB ref="t1"/>', "", "netRelation 'P_A_B1': has no elementB"),
)


@pytest.mark.parametrize(("old", "new", "said"), CHANGES, ids=[said[:40] for _, _, said in CHANGES])
def test_what_is_wrong_is_said_of_the_element(old: str, new: str, said: str, tmp_path: Path) -> None:
    assert old in RAILML
    file = tmp_path / "changed.railml"
    file.write_text(RAILML.replace(old, new, 1), "utf-8")
    with pytest.raises(BadInput) as raised:
        load(file)
    assert said in str(raised.value)
    assert heisoku.run(["check", str(file)]) == BAD_INPUT


def test_sections_are_held_against_the_track() -> None:
    sections = """<tvdSections>
      <tvdSection id="ab"><hasDemarcatingTraindetector ref="a"/><hasDemarcatingTraindetector ref="b"/></tvdSection>
      <tvdSection id="ba"><hasDemarcatingTraindetector ref="b"/><hasDemarcatingTraindetector ref="a"/></tvdSection>
      <tvdSection id="ah"><hasDemarcatingTraindetector ref="a"/><hasDemarcatingTraindetector ref="h"/></tvdSection>
    </tvdSections>"""
    text = RAILML.replace("<assetsForIL>", f"<assetsForIL>{sections}")
    text = text.replace('<route id="a-d">', '<route id="a-d"><hasTvdSection ref="ah"/>')
    imported = load_text("railml", text)
    told = [remark.text for remark in imported.remarks] + [violation.text for violation in imported.violations]
    assert "sections ab, ba are demarcated alike: it is one piece of track" in told
    assert "no piece of track lies between what demarcates section 'ah': a, h" in told
    assert "route 'a-d' names the sections ah, and runs through ab or ba" in told


@needs_shared
@pytest.mark.parametrize(("name", "routes"), PUBLISHED.items())
def test_published_files_are_read(name: str, routes: int) -> None:
    file = SHARED / f"{name}.railml"
    imported = load(file)
    raw: Any = etree.parse(file)
    assert len(imported.layout.routes) == routes == len(list(raw.iterfind(".//{*}route")))
    assert check(imported).verdict == "holds"
    for route in raw.iterfind(".//{*}route"):
        wanted = {
            (item.find("{*}refersToSwitch").get("ref").removeprefix("il_"), item.get("inPosition"))
            for item in route.iterfind("{*}facingSwitchInPosition")
        }
        assert wanted <= set(imported.layout.needs[route.get("id")].items())


@needs_shared
def test_a_published_contradiction_is_named() -> None:
    told = [remark.text for remark in load(SHARED / "gicsafe-5.railml").remarks]
    assert "sections tvd103, tvd98 are demarcated alike: it is one piece of track" in told
    assert heisoku.run(["check", str(SHARED / "gicsafe-5.railml")]) == HOLDS


# ---- damage


def outcome(text: str) -> None:
    """Refused in one line, or read and checked."""
    said = "read"
    try:
        imported = load_text("file", text)
        json.dumps(as_json(imported, check(imported)))
    except BadInput as error:
        said = str(error)
    assert said.isprintable()


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 10**6), st.integers(0, 120), st.text(max_size=5))
def test_text_with_a_piece_exchanged(at: int, length: int, put: str) -> None:
    at %= len(RAILML)
    outcome(RAILML[:at] + put + RAILML[at + length :])


@settings(max_examples=400, deadline=None)
@given(st.integers(0, 10**9))
def test_elements_dropped_doubled_and_changed(seed: int) -> None:
    outcome(spoilt(RAILML, random.Random(seed)))


def spoilt(text: str, chance: random.Random) -> str:
    """The document with a few elements dropped, doubled or moved, and attributes exchanged."""
    root: Any = etree.fromstring(text)
    for _ in range(chance.randint(1, 3)):
        every = list(root.iter("{*}*"))
        if len(every) < 2:
            break
        one, other = chance.choice(every[1:]), chance.choice(every)
        match chance.randrange(5):
            case 0:
                one.getparent().remove(one)
            case 1:
                other.append(etree.fromstring(etree.tostring(one)))
            case 2 if one not in list(other.iterancestors()) and one is not other:
                other.append(one)
            case 3 if one.attrib:
                del one.attrib[chance.choice(list(one.attrib))]
            case _ if one.attrib:
                values = [value for each in every for value in each.attrib.values()]
                odd = ["", "-1", "1e400", "nan", "x" * 300, "10" * 30]
                one.set(chance.choice(list(one.attrib)), chance.choice([*values, *odd]))
    return etree.tostring(root, encoding="unicode")


def test_nothing_outside_of_the_file_is_read(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("3.1", "utf-8")
    for declared in (f'<!ENTITY v SYSTEM "{secret.as_uri()}">', '<!ENTITY v "3.1">'):
        with pytest.raises(BadInput):
            load_text("file", f"<!DOCTYPE railML [{declared}]><railML version='&v;'/>")
    with pytest.raises(BadInput, match="has no netElement"):
        load_text("file", RAILML[: RAILML.index("<infrastructure>")] + "</railML>")
