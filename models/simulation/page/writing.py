"""Writes the page: everything in one file, nothing loaded from anywhere."""

from __future__ import annotations

from models.simulation.outcome import Outcome
from models.simulation.page.scene import scene
from models.whole_page import script_data, template_of


def page_of(found: Outcome) -> str:
    """The page of a simulation as HTML."""
    return template_of("models.simulation.page").render(
        name=found.plan.imported.name.rsplit("/", 1)[-1],
        found=found,
        sim=found.sim,
        data=script_data(scene(found)),
    )
