"""Concrete trains drive, and each thing that happens to them must be a step that the abstract world allows."""

from __future__ import annotations

from collections import Counter
from random import Random

from kernel.names import Read, Run, Tag
from kernel.standstill import ThroughLine
from models.concrete.rails import Rails
from models.concrete.train import Happening, OnRails
from models.simulator.play import Play
from models.world.assumptions import (
    a_healthy_line_reaches_the_tail,
    a_missed_tag_is_overdue_before_the_tail_comes,
    a_pair_passed_in_order_proves_the_exit,
    a_tag_is_read_where_it_lies,
)


class NatureRefusedError(AssertionError):
    """Something that can happen on real track is no step of the abstract world, or leads it elsewhere."""


class Drive:
    """A play whose trains are concrete; ``seen`` counts what happened."""

    def __init__(self, play: Play, rails: Rails, trains: list[OnRails], random: Random, missed: float = 0.0) -> None:
        self.play = play
        self.rails = rails
        self.trains = trains
        self.random = random
        self.missed = missed
        self.seen: Counter[str] = Counter()
        self.compare()

    def compare(self) -> None:
        """Every car is in just the blocks that the abstract track says."""
        for train in self.trains:
            for car, blocks in train.blocks(self.rails).items():
                said = self.play.system.track.at.get(car, frozenset())
                if said != blocks:
                    raise NatureRefusedError(
                        f"{car} is in {sorted(blocks)}, the abstract world has it in {sorted(said)}"
                    )

    def move(self, train: OnRails, run: Run, mm: int) -> None:
        """A train moves so far between two samples; everything on the way happens, in its order."""
        train.look()
        train.reach(self.rails, mm, self.play.system.track.lies)
        mm = min(mm, train.path[-1].to_mm - 1 - train.front_mm)
        done = 0
        happenings = train.happenings(self.rails, mm)
        for at, happening in enumerate(happenings):
            self.happens(train, run, happening)
            self.seen[happening.kind] += 1
            if at + 1 == len(happenings) or happenings[at + 1].after_mm != happening.after_mm:
                train.front_mm += happening.after_mm - done
                done = happening.after_mm
                self.compare()
        self.seen["several things between two samples"] += len(happenings) > 1
        train.front_mm += mm - done
        self.compare()

    def happens(self, train: OnRails, run: Run, what: Happening) -> None:
        """One thing happens: the abstract world must allow it."""
        if what.kind == "enters":
            self.enters(train, run, what)
        elif what.kind == "leaves":
            self.must(self.play.take("car_leaves", car=what.car, block=what.block), what)
        elif what.kind == "head reads" and self.random.random() < self.missed:
            self.head_misses(train, what)
        elif self.random.random() < self.missed:
            self.seen["missed"] += 1
        elif what.kind == "head reads":
            self.head_reads(train, what, what.tag, True)
        else:
            self.tail_reads(train, run, what)

    def head_reads(self, train: OnRails, what: Happening, tag: Tag | None, in_window: bool) -> None:
        """The head's antenna reads a tag."""
        assert tag is not None
        site, system = self.play.site, self.play.system
        cab = system.track.facing[train.name]
        self.must(a_tag_is_read_where_it_lies(site, system, cab, tag), what)
        self.play.take("head_reads", train=train.name, cab=cab, tag=tag, in_window=in_window)

    def head_misses(self, train: OnRails, what: Happening) -> None:
        """The head passes a tag unread; by running distance it is overdue before the tail comes."""
        self.seen["missed"] += 1
        self.play.take("head_misses", train=train.name, tag=what.tag)
        self.play.take("window_passes", train=train.name)

    def enters(self, train: OnRails, run: Run, what: Happening) -> None:
        """A front axle of a car comes into a block: under the run, or after a car that is ahead of it there."""
        layout = self.play.site.layout
        runs = [run, *sorted(r for r in self.play.system.track.rolling if r.train == run.train and r != run)]
        for under in runs:
            if {what.block, what.target} <= layout.claims.get(under.route, frozenset()):
                event = {"run": under, "car": what.car, "block": what.block, "target": what.target}
                if self.play.take("car_moves", **event):
                    self.seen["moves"] += 1
                    return
        ahead = train.cars[: train.cars.index(what.car)]
        event = {"car": what.car, "target": what.target}
        followed = any(self.play.take("car_follows", other=other, **event) for other in ahead)
        self.seen["follows"] += followed
        self.must(followed, what)

    def reads_as_tail(self, train: OnRails, tag: Tag) -> ThroughLine:
        """Take a read by the last car's antenna, and what says whether that is the tail: over a broken line nothing."""
        del tag
        return ThroughLine(answers=not train.standing, is_intact=True, fits=True)

    def tail_reads(self, train: OnRails, run: Run, what: Happening) -> None:
        """The antenna of the last car reads a tag; it need not be the train's tail."""
        assert what.tag is not None
        line = self.reads_as_tail(train, what.tag)
        site, system = self.play.site, self.play.system
        read, cab = Read(what.tag, site.records.record[what.tag]), site.formation.cab[what.car]
        self.must(a_healthy_line_reaches_the_tail(site, system, run, what.car, cab, line), what)
        self.must(a_missed_tag_is_overdue_before_the_tail_comes(site, system, run.train, read.tag, line), what)
        self.must(a_pair_passed_in_order_proves_the_exit(site, system, run, what.car, read), what)
        self.play.take("tail_reads", run=run, car=what.car, cab=cab, line=line, read=read)

    def must(self, allowed: bool, what: Happening) -> None:
        """Nature did it; the abstract world must allow it."""
        if not allowed:
            raise NatureRefusedError(f"the abstract world refuses: {what}")
