"""What is claimed of map matching: the tram is in the range that is found, on a line of any shape (G1)."""

from __future__ import annotations

from kernel.tram.map_matching import Stretch
from models.measures import UM_A_MM, apart
from models.tram.map_matching import (
    Fixing,
    Survey,
    is_its_length,
    look_at,
    run_on,
    take_fix,
    take_in,
    tell,
)
from proofs.theory import Theory, by_name

# ---- the start


def there_is_no_fix_yet(site: Survey, system: Fixing) -> bool:
    """At the start, as after a restart, there is no fix; the tram is somewhere on its line (G1)."""
    return (
        not system.is_fixed
        and not system.is_new
        and not system.foot.is_sound
        and 0 <= system.part_um <= UM_A_MM * system.own.grows_mm
        and is_its_length(system.own, system.length_mm)
    )


# ---- safety


def the_tram_is_on_a_stretch_that_is_found(site: Survey, system: Fixing) -> bool:
    """Once the stretch that it was on at the fix was looked at, a sound table gives a range (G1)."""
    return not is_looked_for(system) or system.found.within is not None


def the_tram_is_not_before_its_range(site: Survey, system: Fixing) -> bool:
    """And the tram is not before it (G1)."""
    within, at_um = system.found.within, UM_A_MM * system.own.from_mm + system.part_um
    return not is_looked_for(system) or within is None or UM_A_MM * within.from_mm <= at_um


def the_tram_is_not_beyond_its_range(site: Survey, system: Fixing) -> bool:
    """Nor beyond it (G1)."""
    within, at_um = system.found.within, UM_A_MM * system.own.from_mm + system.part_um
    return not is_looked_for(system) or within is None or at_um <= UM_A_MM * within.to_mm


def a_place_told_is_within_its_error(site: Survey, system: Fixing) -> bool:
    """The kilometrage of a place that is told is off by no more than is written for it (G1, G2)."""
    at_um, told_mm = UM_A_MM * system.own.from_mm + system.part_um, system.told_mm
    return not system.is_fixed or told_mm is None or apart(UM_A_MM * told_mm, at_um) <= UM_A_MM * site.limits.most_mm


# ---- what it rests on


def is_looked_for(system: Fixing) -> bool:
    """Tell whether the tram's own stretch was looked at for a fix of where it is, and the table is sound so far."""
    return system.is_fixed and system.own_taken and system.found.is_sound


def is_straight(own: Stretch) -> bool:
    """Tell whether a stretch has a length, which is written no shorter, and its kilometrage grows."""
    return (
        0 < own.east_mm * own.east_mm + own.north_mm * own.north_mm <= own.length_mm * own.length_mm
        and own.length_mm > 0
        and own.grows_mm > 0
    )


def a_stretch_has_a_length(site: Survey, system: Fixing) -> bool:
    """It is some mm long, rounded up (G1)."""
    return system.length_mm >= 1


def no_length_is_written_shorter(site: Survey, system: Fixing) -> bool:
    """The length that is written of a straight stretch is no less than its own, rounded up (G1)."""
    return not is_straight(system.own) or system.own.length_mm >= system.length_mm


def the_fix_is_off_by_no_more(site: Survey, system: Fixing) -> bool:
    """By the length that is written of its stretch, too, a fix is off by no more than its error (G1)."""
    own, place = system.own, system.found.place
    if not system.is_fixed or not is_straight(own):
        return True
    x_mm, y_mm, most = place.x_mm - own.start.x_mm, place.y_mm - own.start.y_mm, own.error_mm * own.length_mm
    at = system.part_um * (own.east_mm * own.east_mm + own.north_mm * own.north_mm)
    fixed_at = UM_A_MM * own.grows_mm * (x_mm * own.east_mm + y_mm * own.north_mm)
    return apart(fixed_at, at) <= UM_A_MM * own.grows_mm * most and (
        apart(y_mm * own.east_mm, x_mm * own.north_mm) <= most
    )


def is_its_own(system: Fixing) -> bool:
    """Tell whether the foot that the unit has is that of the tram's last fix, on its own stretch, and that is one."""
    return system.is_fixed and system.is_new and system.foot.is_sound and system.foot.stretch == system.own


def a_sound_stretch_has_a_length(site: Survey, system: Fixing) -> bool:
    """What counts as a stretch has a length, and its kilometrage grows (G1)."""
    foot = system.foot
    return not foot.is_sound or (foot.square_mm2 > 0 and foot.stretch.grows_mm > 0)


def the_tram_is_within_reach_of_the_foot(site: Survey, system: Fixing) -> bool:
    """On its own stretch the tram is no farther from the foot of its fix than that errs (G1)."""
    foot = system.foot
    whole_um, at = UM_A_MM * foot.stretch.grows_mm, system.part_um * foot.square_mm2
    return not is_its_own(system) or whole_um * foot.least_mm2 <= at <= whole_um * foot.most_mm2


def the_fix_is_beside_the_stretch(site: Survey, system: Fixing) -> bool:
    """And the fix no farther beside that stretch (G1)."""
    return not is_its_own(system) or system.foot.is_beside


def the_tram_is_between_the_ends(site: Survey, system: Fixing) -> bool:
    """The tram is between the ends of its stretch (G1)."""
    return 0 <= system.part_um <= UM_A_MM * system.own.grows_mm


INITIAL = (there_is_no_fix_yet,)
SAFETY = (
    the_tram_is_on_a_stretch_that_is_found,
    the_tram_is_not_before_its_range,
    the_tram_is_not_beyond_its_range,
    a_place_told_is_within_its_error,
)
INVARIANTS = (
    *SAFETY,
    a_stretch_has_a_length,
    no_length_is_written_shorter,
    the_fix_is_off_by_no_more,
    a_sound_stretch_has_a_length,
    the_tram_is_within_reach_of_the_foot,
    the_fix_is_beside_the_stretch,
    the_tram_is_between_the_ends,
)
STEPS = (run_on, take_fix, look_at, take_in, tell)

THEORY = Theory(
    "map_matching",
    Survey,
    Fixing,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
