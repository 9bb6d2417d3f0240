"""railML files with one piece more each: branches, clearances, fouling, conflicts, elements that nobody reads."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from models.layouts import CheckResult, Imported, load_text
from models.layouts.conflict_pairs import Conflicts
from tests.independent import raw_railml
from tests.independent.layouts import survey_railml
from tests.independent.raw_native import SLIPS_MM
from tests.independent.raw_railml import Judged, judged
from tests.layouts.railml_made import railml_of
from tests.layouts.stations import plain_station, railjson_of

DATA = railjson_of(plain_station())
PLAIN = railml_of({**DATA, "routes": [each for each in DATA["routes"] if each["entry_point"]["type"] == "Detector"]})
TRACKS = """<track id="trk"><linearLocation><associatedNetElement netElementRef="t1"/></linearLocation></track>
<track id="both"><linearLocation><associatedNetElement netElementRef="t1"/>
<associatedNetElement netElementRef="t2"/></linearLocation></track>"""
NEAR = PLAIN.replace('netElementRef="t1" intrinsicCoord="0.100000000"', 'netElementRef="t1" intrinsicCoord="0.01"')
OVERLAP = '<overlaps><overlap id="o" {}><activeForApproachRoute ref="a-d"/>{}</overlap></overlaps>'
SHORT = PLAIN.replace('netElementRef="t1" intrinsicCoord="0.900000000"', 'netElementRef="t1" intrinsicCoord="0.995"')
SHORT = SHORT.replace('netElementRef="x" intrinsicCoord="0.100000000"', 'netElementRef="x" intrinsicCoord="0.1"')
FOREIGN = '<old:derailerIS xmlns:old="urn:old" id="ghost"/><old:odd xmlns:old="urn:old" id="odd"/>'


def _switch(branches: str, more: str = "", point: str = "P") -> str:
    return f'<switchesIL><switchIL id="il"><refersTo ref="{point}"/>{branches}{more}</switchIL></switchesIL>'


def _branches(left: str | None, right: str | None) -> str:
    told = ((word, ref) for word, ref in (("branchLeft", left), ("branchRight", right)) if ref is not None)
    return "".join(f'<{word} ref="{ref}"/>' if ref else f"<{word}/>" for word, ref in told)


def _marker(track: str, share: str) -> str:
    where = f'netElementRef="{track}" intrinsicCoord="{share}" applicationDirection="both"'
    return f'{TRACKS}<signalIS id="mark"><spotLocation {where}/></signalIS>'


def _conflicts(pairs: list[tuple[str, str]]) -> str:
    told = (f'<refersToRoute ref="{one}"/><conflictsWithRoute ref="{other}"/>' for one, other in pairs)
    rows = "".join(f"<conflictingRoute>{each}</conflictingRoute>" for each in told)
    return f"<conflictingRoutes>{rows}</conflictingRoutes>"


def pieces(following: list[tuple[str, str]], apart: list[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Every file, with its name; ``following``, ``apart``: routes of the plain file that conflict, and that do not."""
    for left, right in (
        *(("t1", "t2"), ("t2", "t1"), ("t1", "t1"), ("w", "t2"), ("trk", "t2"), ("t1", "trk"), ("both", "t2")),
        *((None, "t2"), ("", "t1"), ("a", "t2"), ("t1", None)),
    ):
        yield f"branches {left} {right}", _with(TRACKS, _switch(_branches(left, right)))
    yield "no point", _with("", '<switchesIL><switchIL id="il"/></switchesIL>')
    yield "a joint", _with("", _switch(_branches("t1", "t2"), point="a"))
    marked = '<hasGaugeClearanceMarker ref="mark"/>'
    for track, share, point in (
        *(("t1", "0.05", "P"), ("t1", "0.2", "P"), ("t1", "0.0", "P"), ("t1", "0.9", "Q"), ("t2", "0.95", "Q")),
        *(("z", "0.5", "P"), ("w", "0.9", "P")),
    ):
        yield f"marker {track} {share} {point}", _with(_marker(track, share), _switch("", marked, point))
    for detector in "chb":
        yield f"fouling {detector}", _with("", _switch("", f'<hasFoulingTrainDetectors ref="{detector}"/>'), NEAR)
    both = "".join(f'<hasFoulingTrainDetectors ref="{each}"/>' for each in "ce")
    yield "fouling both legs", _with("", _switch("", both), NEAR)
    for length in ("5", "150", "200", "200.001", "99000"):
        yield f"overlap {length}", _with("", OVERLAP.format(f'length="{length}"', ""))
    for share in ("0.00499", "0.004989"):
        yield (
            f"overlap to {share}",
            _with("", OVERLAP.format("", '<isLimitedBy ref="g"/>'), SHORT.replace("0.1", share)),
        )
    yield "unread", _with(f'<derailerIS id="der"/><derailerIS id="two"/><keyLockIS id="key"/>{FOREIGN}', "")
    told = {
        "all": following,
        "one less": following[1:],
        "ten less": following[10:],
        "eleven less": following[11:],
        "apart": [*following, apart[0][::-1]],
        "itself": [*following, (apart[0][0], apart[0][0])],
        "turned": [(other, one) for one, other in following],
    }
    for name, pairs in told.items():
        yield f"conflicts {name}", _with("", _conflicts(pairs))


def _with(functional: str, assets: str, text: str = PLAIN) -> str:
    text = text.replace("</functionalInfrastructure>", f"{functional}</functionalInfrastructure>")
    return text.replace("<assetsForIL>", f"<assetsForIL>{assets}")


def files() -> Iterator[tuple[str, str]]:
    """The name and the text of every file."""
    return ((f"{name}.railml", text) for name, text in pieces(*routes_of(load_text("plain.railml", PLAIN))))


def routes_of(imported: Imported) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """The pairs of routes that conflict, and those that do not."""
    following = [(str(one), str(other)) for one, other in Conflicts(imported.layout).pairs()]
    return following, sorted(set(combinations(sorted(map(str, imported.layout.routes)), 2)) - set(following))


def differing(imported: Imported, result: CheckResult, text: str) -> list[str]:
    """What the importer sees otherwise than the plain tree; of conflicts those that follow are the kernel's.

    No file has a detector before the tips that fouls its point with one on a leg.
    """
    ours, theirs = judged(text), _of(imported, result)
    layout = imported.layout
    following = {(str(one), str(other)) for one, other in Conflicts(layout).pairs()} if ours.conflicts else set()
    bounds = imported.places.blocks
    fouling = {frozenset((bounds[own], bounds[other])) for own, others in layout.fouls.items() for other in others}
    again, behind = set(), dict[str, tuple[tuple[str, ...], ...]]()
    for point, detector in ours.fouling:
        own = next(block for block, points in layout.points_in.items() if point in points)
        sides = {layout.tag_in[tag] for tag, (mark, *_) in imported.places.tags.items() if mark == detector}
        if own in sides:
            again |= {frozenset((bounds[own], bounds[other])) for other in sides - {own}}
            behind[point] = behind.get(point, ()) + tuple(bounds[other] for other in sides - {own})
        else:
            ours.wrong.add((point, detector))
    again |= {frozenset(pair) for beside in behind.values() for pair in combinations(set(beside), 2)}
    ours.wrong |= ours.conflicts - following
    ends = {} if imported.station is None else {n: j.ports for n, j in imported.station.junctions.items()}
    legs = {(leg.point, ends[leg.point][leg.leg][0]): leg.clear_mm for leg in imported.legs if leg.clear_mm is not None}
    known = {
        leg
        for leg in ours.legs
        if any(ends[each.point][each.leg][0] == leg[1] and each.point == leg[0] for each in imported.legs)
    }
    found = []
    if ours.unread != theirs.unread:
        found.append(f"unread: {theirs.unread} is not {ours.unread}")
    found += _overlaps(imported, result, text)
    if ours.no_main != theirs.no_main:
        found.append(f"no main signals: {theirs.no_main} is not {ours.no_main}")
    if ours.wrong != theirs.wrong:
        found.append(f"wrong: {theirs.wrong} is not {ours.wrong}")
    if legs != {leg: ours.legs[leg] for leg in known}:
        found.append(f"clearance: {legs} is not {ours.legs}")
    if fouling != again:
        found.append(f"fouling: {fouling} is not {again}")
    return found


def _overlaps(imported: Imported, result: CheckResult, text: str) -> list[str]:
    """Overlaps that end elsewhere than by a walk on from the exit, or are shorter than a train slips and not told."""
    if raw_railml.is_version_2(text) or imported.told is None or "<overlap " not in text:
        return []
    marks, again = survey_railml.survey(text).marks, survey_railml.overlaps(text)
    ends = {each.name: marks[each.overlap] for each in imported.told.routes if each.overlap is not None}
    short = {v.elements[0] for v in result.violations if v.axiom == "an overlap is longer than a train slips"}
    found = [f"overlaps end at {ends} and not {again}"] if ends != {name: at for name, (at, _) in again.items()} else []
    told = {name for name, (_, long_mm) in again.items() if long_mm < SLIPS_MM}
    return found + ([f"short overlaps: {short} is not {told}"] if short != told else [])


def _of(imported: Imported, result: CheckResult) -> Judged:
    """The same of what was imported."""
    rules = ("a switch has one left and one right branch", "a detector that fouls a point lies at its block")
    wrong = {tuple(map(str, v.elements)) for v in result.violations if v.axiom in (*rules, "declared conflicts follow")}
    unread = {
        each for rest in result.rests if rest.kind == "unread" for instance in rest.instances for each in instance
    }
    no_main = {str(each) for remark in result.remarks if "no main signals" in remark.text for each in remark.elements}
    return Judged({each.partition(" in line ")[0] for each in unread}, wrong, no_main=no_main)
