"""What comes about at last: runs are permitted, released and given back, trains, blocks and points found again.

## All of it together

**A train that has run its route is released.** Its tail leaves one block after the other, and each is freed
(`a_left_block_is_freed`); there are as many as the route has, and none that was freed is ever held for that run
again. Standing in its destination it tells so, and the overlap is freed (`an_overlap_is_freed`). The block that it
stands in is freed like the others when its tail leaves it under the next run: what a tail leaves is noted for every
run that has begun. A run that holds nothing is forgotten (`a_run_that_holds_nothing_is_forgotten`).

**A unit that restarts** has nothing to report any more. The centre asks, it answers once it stands and is whole, and
is accounted for (`a_train_answers`, `a_train_that_answered_is_accounted_for`). From then on no run of an earlier life
holds anything (the invariant `an_open_run_is_of_the_accounted_life`); what it stands in is held for a run that stands
for it, and it learns which (`a_train_learns_under_which_run_it_stands`), so that its tail frees that too.

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
train is adopted: its terminal must answer, or the train move off. That the train runs, that its tail reads both tags,
and that it can stand short of a run that is wanted back: the world is free to let it stand for ever. That two trains
do not wait for each other: that is the timetable's, and `heisoku simulate` explains it by name.
"""
