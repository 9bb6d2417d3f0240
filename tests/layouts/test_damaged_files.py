"""Whatever is done to a file, it is refused in one line or checked; nothing else comes out."""

from __future__ import annotations

import copy
import json
import random
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from models.layouts import BadInput, as_json, check, load_text
from models.layouts.generate import as_toml
from tests.layouts.stations import SAMPLES, plain_station, railjson_of, table_rows

TEXTS = [json.dumps(railjson_of(plain_station())), as_toml(plain_station())]
TEXTS += [json.dumps(railjson_of(plain_station(), later=True)), SAMPLES[0].read_text("utf-8")]
TABLE = {"interlocking-table": table_rows()}
ODD: list[Any] = [None, True, -1, 0, 1e308, 10**400, "", "x", "P", "a", [], {}, [[]], {"id": "x"}, "A_B1", 1.5]


def outcome(text: str) -> None:
    said = "read"
    try:
        imported = load_text("file", text)
        json.dumps(as_json(imported, check(imported)))
    except BadInput as error:
        said = str(error)
    assert said.isprintable()


def damaged(value: Any, chance: random.Random) -> Any:
    """A value with one place in it exchanged, dropped or doubled."""
    if isinstance(value, dict | list) and value and chance.random() < 0.85:
        changed = copy.copy(value)
        key = chance.choice(list(value)) if isinstance(value, dict) else chance.randrange(len(value))
        how = chance.random()
        if how < 0.1:
            del changed[key]
        elif how < 0.2 and isinstance(changed, list):
            changed.append(changed[key])
        else:
            changed[key] = damaged(value[key], chance)
        return changed
    return chance.choice(ODD)


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(TEXTS), st.integers(0, 10**6), st.integers(0, 200), st.text(max_size=5))
def test_text_with_a_piece_exchanged(text: str, at: int, length: int, put: str) -> None:
    at %= len(text)
    outcome(text[:at] + put + text[at + length :])


@settings(max_examples=500, deadline=None)
@given(st.integers(0, 10**9))
def test_data_with_a_value_exchanged(seed: int) -> None:
    chance = random.Random(seed)
    data = railjson_of(plain_station(), later=chance.random() < 0.3)
    for _ in range(chance.randint(1, 3)):
        data = damaged(data, chance)
    outcome(json.dumps(data))


@settings(max_examples=300, deadline=None)
@given(st.integers(0, 10**9))
def test_table_with_a_value_exchanged(seed: int) -> None:
    chance = random.Random(seed)
    outcome("---\n" + json.dumps(damaged(TABLE, chance)))
