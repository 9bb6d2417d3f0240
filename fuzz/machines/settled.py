"""Settings of Hypothesis that give the same runs every time."""

from __future__ import annotations

from hypothesis import HealthCheck, Phase, settings


def repeatable(examples: int, steps: int) -> settings:
    """So many runs of at most so many rules, without time limits and without memory, one failure at a time."""
    return settings(
        max_examples=examples,
        stateful_step_count=steps,
        derandomize=True,
        database=None,
        deadline=None,
        report_multiple_bugs=False,
        print_blob=False,
        phases=(Phase.generate, Phase.shrink),
        suppress_health_check=list(HealthCheck),
    )
