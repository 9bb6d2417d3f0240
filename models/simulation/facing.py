"""Which end of a train leads in a run: told by the tag at the end of the block that it begins in (T2).

A network may lead a train back upon itself the other way round, so that its routes have no common direction; which
car is last in a run is then a matter of how the train stands when it is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from kernel.maps import Map
from kernel.names import Cab, Car, Run, Tag, Train
from models.concrete.rails import Rails
from models.concrete.train import OnRails
from models.layouts.blocks import opposite
from models.layouts.track import Cut, Heading, Joint
from models.world.formations import ByRun
from models.world.state import Formation


def onwards(rails: Rails, heading: Heading) -> list[Heading]:
    """Where rails lead at the end of a segment, however points lie."""
    end = rails.segments.at[heading]
    if isinstance(end, Cut):
        return [end.beyond]
    return [onward for _, _, onward in rails.segments.onward(end)] if isinstance(end, Joint) else []


def exits(rails: Rails, heading: Heading) -> frozenset[Tag]:
    """The tags at the ends of a block that a movement in it may come to, however its points lie."""
    block, todo, seen, found = rails.block[heading[0]], [heading], {heading}, set[Tag]()
    while todo:
        here = todo.pop()
        end = rails.segments.at[here]
        if isinstance(end, Cut) and rails.boundary(here) and (tag := rails.tag_at.get((end.mark, block))) is not None:
            found.add(tag)
        for each in onwards(rails, here):
            if rails.block[each[0]] == block and each not in seen:
                seen.add(each)
                todo.append(each)
    return frozenset(found)


def leads_forward(rails: Rails, train: OnRails, tag: Tag | None) -> bool:
    """Whether the train's first car leads to a tag at the end of the block that it is in."""
    return tag in exits(rails, next(piece.heading for piece in train.path if piece.to_mm > train.front_mm))


def leads_back(rails: Rails, train: OnRails, tag: Tag | None) -> bool:
    """Whether its last car does, once it has changed ends."""
    return tag in exits(rails, opposite(next(piece.heading for piece in train.path if piece.to_mm > train.rear_mm)))


@dataclass
class Orders:
    """The order of the cars of each train, first to last, in every run that was asked for."""

    cars: dict[Train, tuple[Car, ...]]
    of_run: dict[Run, tuple[Car, ...]] = field(default_factory=dict)

    def note(self, run: Run, train: OnRails, forward: bool) -> None:
        """Write down how a train stands, or will stand, when it begins a run."""
        order: Sequence[Car] = [*train.cars, *train.standing]
        self.of_run[run] = tuple(order) if forward else tuple(reversed(order))

    def formation(self) -> Formation:
        """The formation for every run."""

        def order(run: Run) -> tuple[Car, ...]:
            return self.of_run.get(run, self.cars[run.train])

        def ahead(run: Run) -> Map[Car, frozenset[Car]]:
            return {car: frozenset(order(run)[:place]) for place, car in enumerate(order(run))}

        known = frozenset(self.cars)
        return Formation(
            train_of={car: train for train, cars in self.cars.items() for car in cars},
            front=ByRun(known, lambda run: Cab(f"cab of {order(run)[0]}")),
            last=ByRun(known, lambda run: order(run)[-1]),
            ahead=ByRun(known, ahead),
            cab={car: Cab(f"cab of {car}") for cars in self.cars.values() for car in cars},
        )
