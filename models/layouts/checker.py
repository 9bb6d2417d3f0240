"""``heisoku check``: hold a layout against every axiom and tell all that is wrong with it.

The work is near-linear in the size of the layout: each axiom is searched once, and nothing is
looked up that the axiom does not name.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from types import ModuleType
from typing import Any

import models.axioms
from kernel.names import Block, Point, Position, Tag
from models.layouts.axiom_code import Bindings, CompiledAxiom, Failure, axioms_of, compile_axiom
from models.layouts.clearance import foul_legs, trains_side_by_side
from models.layouts.measures import CLEARANCE_MM
from models.layouts.rests import rests_of
from models.layouts.results import CheckResult, Imported, Rest, Verdict, Violation
from models.layouts.sorts import Sorts


@cache
def compiled_axioms(module: ModuleType = models.axioms) -> tuple[CompiledAxiom, ...]:
    """The axioms of a module, each ready to be searched."""
    return tuple(compile_axiom(axiom) for axiom in axioms_of(module))


def check(
    imported: Imported,
    axioms: Sequence[CompiledAxiom] | None = None,
    clearance_mm: int = CLEARANCE_MM,
    strict: bool = False,
) -> CheckResult:
    """The verdict on a layout, with every violation of every axiom and those found at import, and what it rests on.

    ``clearance_mm``: what a leg of a point must have of which no clearance is told.  ``strict``: whatever is taken
    because the file does not say it is a violation.
    """
    rests = rests_of(imported)
    violations = [*imported.violations, *foul_legs(imported.legs, clearance_mm)]
    violations += trains_side_by_side(imported.legs, imported.station, imported.layout.fouls, clearance_mm)
    checked: dict[str, int] = {}
    for axiom in compiled_axioms() if axioms is None else axioms:
        failures, checked[axiom.name] = axiom.failures(imported.layout, imported.ground)
        violations += sorted((explain(imported, axiom, failure) for failure in failures), key=lambda v: v.text)
    if strict:
        violations += [_not_declared(rest) for rest in rests if not rest.declared]
    unique = tuple(dict.fromkeys(violations))
    verdict: Verdict = "does not hold" if unique else "holds"
    return CheckResult(imported.name, verdict, unique, imported.remarks, checked, rests, clearance_mm, strict)


def _not_declared(rest: Rest) -> Violation:
    """What a strict verdict must not rest on."""
    elements = dict.fromkeys(element for instance in rest.instances for element in instance)
    text = f"the verdict rests on {rest.text}: {_shown(rest.instances)}"
    return Violation("nothing rests on a default", tuple(elements), text)


def rest_line(rest: Rest) -> str:
    """What a verdict rests on, on one line."""
    return f"{rest.text}: {_shown(rest.instances)}"


def _shown(instances: Sequence[Sequence[str]]) -> str:
    """The first of them."""
    more = " …" if len(instances) > SHOWN else ""
    return "; ".join(", ".join(instance) for instance in instances[:SHOWN]) + more


SHOWN = 5
"""So many of what a verdict rests on are named on a line; the record has all.  Elements of a violation are all told."""


def explain(imported: Imported, axiom: CompiledAxiom, failure: Failure) -> Violation:
    """A failure as a sentence, with the elements of the input file that take part in it."""
    sorts = Sorts(imported)
    elements: list[str] = []
    said: list[str] = []
    sort_of = {name: sorts.of_variable(name, failure.part.binders) for name in failure.bindings}
    for name, value in failure.bindings.items():
        elements += sorts.elements(sort_of[name], value)
        said.append(f"{_words(name)} '{value}'" if value is not None else f"no {_words(name)}")
    known: dict[str, Any] = {"layout": imported.layout, "ground": imported.ground, **failure.bindings}
    absent = None
    for text, code in failure.part.terms:
        try:
            value = eval(code, {}, known)
        except LookupError:
            absent = text
            break
        if isinstance(value, str):
            sort = sorts.of_expression(text, failure.part.binders)
            if sort != Block or Tag not in sort_of.values():  # a block has other boundaries than the tag's
                elements += sorts.elements(sort, value)
            said.append(f"{text} = '{value}'")
    for point, position in _leading_there(imported, failure.bindings):
        elements += sorts.elements(Point, point)
        said.append(f"led there by point '{point}' in '{position}'")
    fault = f"{absent} is missing" if failure.missing and absent else f"'{failure.part.source}' fails"
    where = ", ".join(said) or "the layout"
    text = f"{axiom.sentence} Not so for {where}: {fault}."
    return Violation(axiom.name, tuple(dict.fromkeys(elements)), text)


def _leading_there(imported: Imported, bindings: Bindings) -> Iterable[tuple[Point, Position]]:
    """The points of a route that lead its train from a block of it to a target it is not to be led to."""
    if not {"route", "block", "target"} <= set(bindings):
        return []
    route, block, target = (bindings[name] for name in ("route", "block", "target"))
    demands = imported.ground.leads.get(route, {}).get(block, {}).get(target, {})
    needs = imported.layout.needs.get(route, {})
    return [(point, demands[point]) for point in sorted(demands) if needs.get(point) == demands[point]]


def _words(name: str) -> str:
    return name.replace("_", " ")


def as_json(imported: Imported, result: CheckResult) -> dict[str, object]:
    """The result as plain data, for ``--json``."""
    layout = imported.layout
    return {
        "layout": result.name,
        "format": imported.kind,
        "sha256": imported.sha256,
        "verdict": result.verdict,
        "clearance_mm": result.clearance_mm,
        "strict": result.strict,
        "exit_code": result.exit_code,
        "counts": {
            "blocks": len(layout.blocks),
            "routes": len(layout.routes),
            "points": len(layout.points),
            "tags": len(layout.tag_in),
        },
        "checked": dict(result.checked),
        "violations": [_plain(v.elements, v.text) | {"axiom": v.axiom} for v in result.violations],
        "rests": [
            {
                "on": rest.kind,
                "declared": rest.declared,
                "count": len(rest.instances),
                "instances": [list(instance) for instance in rest.instances],
                "text": rest.text,
            }
            for rest in result.rests
        ],
        "remarks": [_plain(remark.elements, remark.text) for remark in result.remarks],
    }


def _plain(elements: Sequence[str], text: str) -> dict[str, object]:
    return {"elements": list(elements), "text": text}
