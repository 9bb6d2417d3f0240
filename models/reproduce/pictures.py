"""The pictures as PNG files, without a screen."""

from __future__ import annotations

import io
from collections.abc import Iterator

from models.reproduce.tables import Picture

COLOURS = ("#0b5394", "#b45f06", "#38761d", "#741b47", "#134f5c", "#7f6000")
STYLES = ("--", ":", "-.")
MARKS = ("o", "s", "^", "D", "v", "x")


def png(picture: Picture) -> bytes:
    """Draw one picture: 1600 × 960 pixels."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(10, 6), dpi=160, layout="constrained")
    colours = _colours()
    for name, (x, y) in picture.lines.items():
        axes.plot(x, y, label=name, color=next(colours), linewidth=1.8)
    for mark, (name, (x, y)) in zip(MARKS, picture.points.items(), strict=False):
        axes.scatter(x, y, label=name, color=next(colours), marker=mark, s=22, alpha=0.75, linewidths=0.8)
    if picture.bars:
        values = list(picture.bars.values())
        axes.hist(
            values, bins=list(picture.edges), stacked=True, label=list(picture.bars),
            color=[next(colours) for _ in values], edgecolor="white", linewidth=0.6,
        )  # fmt: skip
    for style, (name, levels) in zip(STYLES, picture.levels.items(), strict=False):
        for number, level in enumerate(levels):
            axes.axhline(level, label=None if number else name, color="#444444", linestyle=style, linewidth=1.2)
    for style, (name, place) in zip(STYLES, picture.places.items(), strict=False):
        axes.axvline(place, label=name, color="#990000", linestyle=style, linewidth=1.2)
    axes.set(title=picture.title, xlabel=picture.x, ylabel=picture.y)
    axes.grid(visible=True, color="#dddddd", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.margins(y=0.08)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=9, frameon=False)
    out = io.BytesIO()
    figure.savefig(out, format="png", metadata={"Software": None})
    pyplot.close(figure)
    return out.getvalue()


def _colours() -> Iterator[str]:
    while True:
        yield from COLOURS
