"""The goal structure (GSN) as shapes: the top goal, its subgoals below one another, and right of each what it rests on.

A goal is a rectangle, a solution a circle; a defeater, with what is done about it, stands in a dashed box.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from evidence.case import Case, Claim
from evidence.records.showing import Came, Shown
from evidence.report.words import wrapped

WIDTH = 1320
SPINE, GOAL_X, GOAL_W = 26, 60, 372
SOLUTION_X, SOLUTION_W, SOLUTION_H, IN_A_ROW = 474, 92, 88, 5
DEFEATER_X, DEFEATER_W = 966, 340
LINE, PAD, GAP = 16, 10, 22
COLUMNS = 56
"""Characters in a line of a box."""
RADIUS, BELOW = 25, 12
SHORT = 15
"""Characters in a line below a circle."""

WORST: tuple[Came, ...] = ("does not hold", "not shown", "holds")


@dataclass(frozen=True)
class Box:
    """A goal or a defeater: where, its lines of text, and what it comes to."""

    x: float
    y: float
    width: float
    height: float
    title: str
    lines: tuple[str, ...]
    came: Came
    link: str


@dataclass(frozen=True)
class Circle:
    """A solution: one kind of evidence, of one theory where there are several; ``counted``: how many hold, of how many.

    ``evidence``: the first of them, that the drawing leads to; ``names``: all.
    """

    x: float
    y: float
    counted: str
    label: tuple[str, ...]
    came: Came
    evidence: str
    names: str


@dataclass
class Drawing:
    """All shapes, and the paths between them."""

    width: int = WIDTH
    height: float = 0
    goals: list[Box] = field(default_factory=list)
    defeaters: list[Box] = field(default_factory=list)
    circles: list[Circle] = field(default_factory=list)
    supported: list[str] = field(default_factory=list)
    challenged: list[str] = field(default_factory=list)
    also: list[tuple[str, str]] = field(default_factory=list)


def worst(came: Iterator[Came]) -> Came:
    """The worst of several; nothing at all shows nothing."""
    found = set(came)
    return next((each for each in WORST if each in found), "not shown")


def argued(case: Case, shown: Mapping[str, Shown]) -> Mapping[str, Came]:
    """What each claim comes to: no better than the worst of what it rests on."""
    by_number = {claim.number: claim for claim in case.claims}

    def come(claim: Claim, above: tuple[str, ...]) -> Came:
        evidence = (shown[name].verdict if name in shown else "not shown" for name in claim.evidence)
        if claim.number in above:
            return "not shown"
        below = (come(by_number[name], (*above, claim.number)) for name in claim.claims if name in by_number)
        return worst(iter([*evidence, *below]))

    return {number: come(claim, ()) for number, claim in by_number.items()}


def drawn(case: Case, shown: Mapping[str, Shown]) -> Drawing:
    """Draw the goal structure; subgoals that another subgoal rests on as well are named beside it."""
    came = argued(case, shown)
    top, below = case.claims[0], case.claims[1:]
    drawing = Drawing()
    y = _goal(drawing, top, came[top.number], SPINE - 14, 8.0, DEFEATER_X - GAP - SPINE)
    y = _defeater(drawing, top, 8.0, y)
    ends = []
    for claim in below:
        y += GAP
        bottom = _goal(drawing, claim, came[claim.number], GOAL_X, y, GOAL_W)
        middle = y + 20
        ends.append(middle)
        bottom = max(bottom, _solutions(drawing, claim, shown, y, middle), _defeater(drawing, claim, y, bottom))
        y = bottom
    first = drawing.goals[0].y + drawing.goals[0].height
    drawing.supported += [f"M{SPINE} {first:g}V{end:g}H{GOAL_X}" for end in ends]
    drawing.height = y + 10
    return drawing


def _goal(drawing: Drawing, claim: Claim, came: Came, x: float, y: float, width: float) -> float:
    """Draw a goal, and give where it ends."""
    more = f" Rests on {', '.join(claim.claims)} too." if claim.claims and x == GOAL_X else ""
    lines = tuple(wrapped(claim.text + more, int(COLUMNS * width / GOAL_W)))
    height = 2 * PAD + LINE * (len(lines) + 1)
    drawing.goals.append(Box(x, y, width, height, f"{claim.number}: {came}", lines, came, f"#{claim.number}"))
    return y + height


def _solutions(drawing: Drawing, claim: Claim, shown: Mapping[str, Shown], y: float, middle: float) -> float:
    """Draw what a goal rests on, and give where it ends."""
    groups: dict[str, list[str]] = {}
    for name in claim.evidence:
        kind, _, which = name.partition(":")
        groups.setdefault(f"{kind} {which.split('.')[0]}".strip() if kind == "prove" else kind, []).append(name)
    for place, (label, names) in enumerate(groups.items()):
        x = SOLUTION_X + SOLUTION_W * (place % IN_A_ROW) + SOLUTION_W / 2
        top = y + SOLUTION_H * (place // IN_A_ROW) + RADIUS + BELOW
        verdicts = [shown[name].verdict if name in shown else "not shown" for name in names]
        drawing.circles.append(
            Circle(
                x,
                top,
                f"{verdicts.count('holds')}/{len(names)}",
                tuple(wrapped(label.replace("_", " "), SHORT, 2)),
                worst(iter(verdicts)),
                names[0],
                ", ".join(names),
            )
        )
    if not groups:
        return y
    rows = (len(groups) - 1) // IN_A_ROW + 1
    for row in range(rows):
        last = min(IN_A_ROW, len(groups) - row * IN_A_ROW) - 1
        level = y + SOLUTION_H * row + RADIUS + BELOW
        end = SOLUTION_X + SOLUTION_W * last + SOLUTION_W / 2
        drawing.supported.append(f"M{GOAL_X + GOAL_W} {middle:g}H{SOLUTION_X - 18}V{level:g}H{end:g}")
    return y + SOLUTION_H * rows


def _defeater(drawing: Drawing, claim: Claim, y: float, bottom: float) -> float:
    """Draw what could defeat a goal, and give where it ends."""
    if not claim.defeaters.strip("– "):
        return y
    lines = tuple(wrapped(claim.defeaters.replace("`", ""), int(COLUMNS * DEFEATER_W / GOAL_W)))
    height = 2 * PAD + LINE * (len(lines) + 1)
    title = f"defeater of {claim.number}"
    drawing.defeaters.append(Box(DEFEATER_X, y, DEFEATER_W, height, title, lines, "not shown", f"#{claim.number}"))
    begins = drawing.goals[-1].x + drawing.goals[-1].width
    drawing.challenged.append(f"M{DEFEATER_X} {y + 5:g}H{begins:g}")
    return max(y + height, bottom)
