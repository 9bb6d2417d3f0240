"""Pages that are one file: everything is in it, and nothing is loaded from anywhere."""

from __future__ import annotations

import json
from collections.abc import Callable

from jinja2 import Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

TEMPLATE = "page.html.jinja"
"""By this name the template of a page lies beside what writes it."""


def template_of(package: str, **filters: Callable[..., object]) -> Template:
    """The template of a package; whatever is put into it is escaped, and a name that is not given is an error."""
    environment = Environment(
        loader=PackageLoader(package, "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= filters
    return environment.get_template(TEMPLATE)


def script_data(data: object) -> Markup:
    """What a page's script shows, as JSON that cannot end the script element."""
    text = json.dumps(data, ensure_ascii=True, separators=(",", ":"))
    return Markup(text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026"))
