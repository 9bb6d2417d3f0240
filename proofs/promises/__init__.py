"""What comes about at last: runs are permitted, run, released and given back, trains, blocks and points found again.

## All of it together

**A train that is permitted gets to its destination.** Its brake lets it out of the block that it is in
(`a_permitted_train_is_let_out_of_its_block`), which is what its orders tell the computer on board: an end of authority
beyond that block. From the standstill the computer lets its brake off once the driver acknowledges, and while he runs
on, however slowly, the way to the end gets smaller with each cycle, until the brake stops the train for its end or for
a cause that has a name (`train.a_train_that_may_run_comes_to_its_end`). So its head gets into the next block
(`a_head_gets_into_the_next_block`), reads both tags of the boundary and is known there
(`a_head_is_known_beyond_the_boundary`), and all of it begins anew with the next block. A run is led into each of its
blocks once and out of it once, so that there are as many rounds as its way has blocks. A train that came to rest
before is let out anew. Held in its destination it tells that it stands (`a_train_in_its_destination_tells_it`).

**No machine on board stops it for nothing.** Of the eight that may demand the brake each has a cause that the promise
names; what such a cause is worth is claimed beside it, of a train whose sensors, motors, brake and antennas keep what
is assumed of them:

- a lost position: none, while each cycle is as long as it may be, and each fix has a place in common with the range
  (`train.no_fix_contradicts`)
- a broken bound of motors or brake: none, once they were inspected, while both keep what is written of them
  (`train.a_sound_brake_is_not_accused`)
- an overdue tag: none, while the head reads each tag where it is listed, and the range is no wider than is written
  (`train.no_tag_still_ahead_is_called_missing`)
- a split: none, while the train is whole, and no sensor beyond its error (`split.no_false_alarm`)
- an overspeed: none, while the speed and the width of its range are within what the track allows
  (`train.the_speed_is_what_the_computer_says`)
- a restriction ahead: none, while it is farther than the way to be slow there, reckoned from the far ends of both
  ranges (said so in the promise)
- a train that rolled back: none, while the pulses of its wheel have not gone back farther than is written (said so by
  its machine alone)
- orders that do not let it proceed: none, while the run gives authority (`a_permitted_train_is_let_out_of_its_block`)

**A train that has run its route is released.** Its tail is known at each boundary that the head has passed and then
beyond it, over a healthy line (`a_tail_is_known_at_the_boundary`, `a_tail_is_known_beyond_the_boundary`): so it
leaves one block after the other, and each is freed (`a_left_block_is_freed`); there are as many as the route has, and
none that was freed is ever held for that run again. Standing in its destination it tells so, and the overlap is freed
(`an_overlap_is_freed`). The block that it stands in is freed like the others when its tail leaves it under the next
run: what a tail leaves is noted for every run that has begun. A run that holds nothing is forgotten
(`a_run_that_holds_nothing_is_forgotten`).

**A unit that restarts** has nothing to report any more. The centre asks, it answers once it stands and is whole, and
is accounted for (`a_train_answers`, `a_train_that_answered_is_accounted_for`). From then on no run of an earlier life
holds anything (the invariant `an_open_run_is_of_the_accounted_life`); what it stands in is held for a run that stands
for it, and it learns which (`a_train_learns_under_which_run_it_stands`), so that its tail frees that too. Where it
restarted astride a boundary the tail has nothing to be compared with there, and only its next restart frees the block
behind (docs/limits.md).

**A centre that restarts** has lost everything. When every train is accounted for each lost block is found
(`a_lost_block_is_found`), and each lost point that no train stands over (`a_lost_point_is_found`).

**A run that is asked for** gets its permit once its points are proved (`a_proved_run_is_permitted`), or is given back
(`a_run_wanted_back_is_freed`); one that its train was not told of yet is withdrawn at once.

**A train that holds what it can neither run under nor give back**, at rest, is located anew for its driver: it answers
once more (`a_train_answers`), which drops every authority, and what it held ends as after a restart. That nothing
stands for ever so is searched for, and not proved, in worlds that share nothing with the proofs
(`tests/independent/world/settled.py`).

**What is not promised.** That a point's terminal confirms: a confirmation can be overtaken on a shared flank point,
or a point be stuck ([limits](limits.md)); the signaller withdraws the run then. That a lost point under a standing
train is adopted: its terminal must answer, or the train move off. That the driver runs on and acknowledges, that the
antennas read, that the line reaches the tail, and that a train can stand short of a run that is wanted back: that is
asked as fairness, and the world is free to let a train stand for ever. Nor that an end of authority in millimetres
comes with each block: the joint proves that it is no farther than the orders, and not that it is as far. That a train
whose brake came on for a cause goes on: a second loop that is open stays so until the unit begins a new life, and a
train that is lost, split or accused waits for staff. That two trains do not wait for each other: that is the
timetable's, and `heisoku simulate` explains it by name.
"""
