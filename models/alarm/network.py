"""When a message arrives that was sent at some second: the mobile network, with its faults (A1)."""

from __future__ import annotations

from typing import Any

from models.alarm.faults import KIND
from models.alarm.moving import noise
from models.alarm.windows import is_on
from models.compiled import compiled

LATEST_S = 14
"""No message arrives later."""
SOON_S = 3
"""Nor later than this, while the network is neither slow nor repeats itself."""
SLOW, REPEATS = KIND["slow"], KIND["repeats"]
ANOTHER = 10_000
"""Messages to another handset take their own time."""
FIX, SHOWN, LISTED = 0, 100, 200
"""What a message is of; trains' numbers are added to the first two."""


@compiled(forceinline=True)
def is_late(day: Any, second: int) -> bool:
    """Tell whether messages may be late that are sent now."""
    return is_on(day, SLOW, second) or is_on(day, REPEATS, second)


@compiled(forceinline=True)
def takes_s(day: Any, sent_s: int, what: int) -> int:
    """Give how many seconds a message takes until the second in which the handset sounds with it."""
    drawn = noise(day.key, sent_s, 1_000 + what + ANOTHER * day.handset)
    if is_on(day, SLOW, sent_s):
        return int(2 + drawn % (abs(day.size[SLOW]) - 1))
    return 1 if drawn & 15 else 3


@compiled(forceinline=True)
def send(day: Any, second: int, what: int, arrives_s: Any) -> None:
    """Send a message: write down in which seconds it arrives, first and again, in the row of this second."""
    row = second % arrives_s.shape[0]
    first_s = second + takes_s(day, second, what)
    arrives_s[row, 0], arrives_s[row, 1] = first_s, -1
    if is_on(day, REPEATS, second):
        drawn = noise(day.key, second, 2_000 + what + ANOTHER * day.handset)
        if drawn % 3 == 0:
            arrives_s[row, 1] = first_s + 1 + drawn % 4
