"""Names that are drawn alike, from groups of signs written down by hand."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator

ALIKE = (
    *("AАΑ", "BВΒ", "EЕΕ", "3ЗӠ", "KКΚ", "MМΜϺ", "HНΗ", "OОΟ", "PРΡ", "CСϹ", "TТΤ", "YУΥҮ", "XХΧ", "ZΖ", "IІΙӀ", "NΝ"),
    *("aаαɑ", "eеҽ", "oоο", "pрρ", "cсϲ", "yуү", "xх", "iіι", "jјϳ", "sѕ", "dԁ", "qԛ", "wԝѡ", "SЅ", "JЈͿ", "vνѵ"),
    *("hһҺ", "lӏ", "GԌ", "WԜ", "VѴ", "bЬ", "6б", "rг", "FϜ", "uυ", "gɡ"),
    *("ГΓ", "ПΠ", "ФΦ", "ѰΨ", "ЛΛ", "кκ", "пπ", "тτ", "фφ", "ѱψ"),
    *(
        "-‐‑‒–—―−ー一",
        "ニ二",
        "カ力",
        "ロ口",
        "エ工",
        "タ夕",
        "ハ八",
        "ト卜",
        "オ才",
        "チ千",
        "ヘへ",
        "リり",
        "ベべ",
        "ペぺ",
        "○〇",
    ),
)
FIRST = {sign: group[0] for group in ALIKE for sign in group}


def as_drawn(name: str) -> str:
    """What is left of a name when signs drawn alike are one sign, and spaces at its ends and twice are gone."""
    signs = "".join(FIRST.get(sign, sign) for sign in name)
    bare = "".join(FIRST.get(sign, sign) for sign in unicodedata.normalize("NFKD", signs))
    signs = unicodedata.normalize("NFKC", bare)
    return " ".join(part for part in signs.split(" ") if part)


def drawn_alike(names: Iterable[str]) -> Iterator[tuple[str, ...]]:
    """Each group of names that nobody can tell apart."""
    groups: dict[str, set[str]] = {}
    for name in names:
        groups.setdefault(as_drawn(name), set()).add(name)
    yield from (tuple(sorted(group)) for group in groups.values() if len(group) > 1)
