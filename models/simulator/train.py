"""A train in traffic: where it is, car by car and boundary by boundary, and what its antennas read (T2, T5)."""

from __future__ import annotations

from dataclasses import dataclass, field

from kernel.names import Block, Cab, Car, Read, Route, Run, Tag, Train
from models.simulator.play import Play
from models.simulator.senses import BROKEN, WHOLE


@dataclass
class OnTrack:
    """A train of two cars as it stands on the track.

    ``trail``: the blocks it is in, rear to front.  ``joints``: the boundaries between them, each
    by the tag on its rear side.  ``front``, ``rear``: its cars in the running direction.
    """

    train: Train
    front: Car
    rear: Car
    trail: list[Block]
    joints: list[Tag] = field(default_factory=list)

    def turn(self, play: Play) -> None:
        """Change ends: the other car is in front."""
        self.front, self.rear = self.rear, self.front
        self.trail.reverse()
        self.joints = [play.site.layout.partner[tag] for tag in reversed(self.joints)]

    def faces(self, play: Play, run: Run) -> bool:
        """Whether the front car leads in the direction of a run."""
        return play.site.formation.last[run] == self.rear

    def cab(self, play: Play, car: Car) -> Cab:
        """The cab on a car."""
        return play.site.formation.cab[car]


def boundary(play: Play, route: Route, block: Block) -> Tag | None:
    """The tag on a route at the end of a block; none where its list ends before."""
    layout = play.site.layout
    tag: Tag | None = layout.first_tag[route]
    while tag is not None:
        if layout.tag_in[tag] == block and layout.tag_in[layout.partner[tag]] == layout.way[route].get(block):
            return tag
        tag = layout.tag_after[route].get(tag)
    return None


def front_passes(play: Play, train: OnTrack, run: Run) -> bool:
    """The head reads the pair at the end of its block and the front car goes over; tell whether it did."""
    layout, block = play.site.layout, train.trail[-1]
    tag, target = boundary(play, run.route, block), layout.way[run.route].get(block)
    if tag is None or target is None:
        return False
    cab = play.site.formation.front[run]
    play.take("head_reads", train=train.train, cab=cab, tag=tag, in_window=True)
    if not play.take("car_moves", run=run, car=train.front, block=block, target=target):
        return False
    train.trail.append(target)
    train.joints.append(tag)
    play.take("head_reads", train=train.train, cab=cab, tag=layout.partner[tag], in_window=True)
    play.take("car_leaves", car=train.front, block=block)
    return True


def rear_passes(play: Play, train: OnTrack, run: Run, healthy: bool = True, missed: bool = False) -> bool:
    """The rear car goes over the rearmost boundary and the tail reads the pair; ``missed``: only one of it."""
    block, target, tag = train.trail[0], train.trail[1], train.joints[0]
    if target not in play.system.track.at[train.rear] and not drawn_on(play, train, run, block, target):
        return False
    if not play.take("car_leaves", car=train.rear, block=block):
        return False
    del train.trail[0], train.joints[0]
    for read in (tag, play.site.layout.partner[tag]):
        if not (missed and read == tag):
            tail_reads(play, train, run, read, healthy)
    return True


def drawn_on(play: Play, train: OnTrack, run: Run, block: Block, target: Block) -> bool:
    """The rear car goes on under a run the train rolls in, or after the front car where that still is."""
    runs = [run, *sorted(other for other in play.system.track.rolling if other.train == train.train and other != run)]
    for under in runs:
        claims = play.site.layout.claims.get(under.route, frozenset())
        event = {"run": under, "car": train.rear, "block": block, "target": target}
        if block in claims and target in claims and play.take("car_moves", **event):
            return True
    return play.take("car_follows", car=train.rear, other=train.front, target=target)


def rear_must_follow(train: OnTrack) -> bool:
    """Whether the front may not go on before the rear has: coupled cars are in one block or in neighbours."""
    return len(train.trail) > 1


def tail_reads(play: Play, train: OnTrack, run: Run, tag: Tag, healthy: bool) -> None:
    """The tail antenna reads a tag."""
    play.take(
        "tail_reads",
        run=run,
        car=train.rear,
        cab=train.cab(play, train.rear),
        line=WHOLE if healthy else BROKEN,
        read=Read(tag, play.site.records.record[tag]),
    )
