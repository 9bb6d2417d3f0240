"""Writes the page: everything in one file, nothing loaded from anywhere."""

from __future__ import annotations

import json

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from models.simulation.outcome import Outcome
from models.simulation.page.scene import scene

TEMPLATE = "page.html.jinja"


def page_of(found: Outcome) -> str:
    """The page of a simulation as HTML."""
    environment = Environment(
        loader=PackageLoader("models.simulation.page", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    data = json.dumps(scene(found), ensure_ascii=True, separators=(",", ":"))
    return environment.get_template(TEMPLATE).render(
        name=found.plan.imported.name.rsplit("/", 1)[-1],
        found=found,
        sim=found.sim,
        data=Markup(data.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")),
    )
