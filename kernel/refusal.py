"""Why a request was refused: the operator asks, the kernel answers (T9)."""

from __future__ import annotations

from enum import Enum


class Refusal(Enum):
    """One reason a member, in the words of the field."""

    UNKNOWN_ROUTE = "there is no such route"
    SERIALS_EXHAUSTED = "the last run number has been used: renew the lasting memory"
    SERIAL_NOT_NEW = "the run number is not newer than every one granted before"
    TRAIN_NOT_ACCOUNTED_FOR = "the train has not told, in this life, where it stands"
    START_NOT_SECURED = "the run that the train stands under is not set"
    START_NOT_HELD = "the start block is not held for this train"
    START_IS_RUN_THROUGH = "an earlier run of the train leads out of the start block the same way, and still holds it"
    UNKNOWN_BLOCK = "there is no such block"
    BLOCK_HELD_FOR_ANOTHER = "a block is held for another train"
    BLOCK_LOST = "a block of the route has not been recovered since the restart"
    FOULING_BLOCK_HELD = "a block that fouls one of these is held for another train"
    FOULING_BLOCK_LOST = "a block that fouls the route has not been recovered since the restart"
    POINT_LOST = "a point of the route has not been recovered since the restart"
    POINT_LOCKED_OTHERWISE = "a point of the route is locked in another position"
    POINT_BEING_LAID = "a point in a block is being laid for another train"
    START_WANTED_BACK = "the run that the train stands under is wanted back"
    NO_SUCH_RUN = "there is no such run"
    WRONG_STAGE = "the run is not at that stage"
    LISTS_DIFFER = "the train keeps another tag list of the route than it was sent"
    POINTS_NOT_PROVED = "a point of the route is not yet proved"
    A_RUN_LEADS_ON = "another run of the train starts in what this one covers: take that one back first"
    NOT_CLAIMED = "the block is not held for this run"
    NOT_THE_TAGS_OF_THE_BLOCK = "the tags reported are not the pair at the end of this block"
    RECORD_DIFFERS = "what was read differs from what is written in the tag"
    WRONG_EPOCH = "the message is from before the restart of the centre"
    WRONG_LIFE = "the message is from before the restart of the unit or terminal"
    UNKNOWN_TRAIN = "the train is not in the fleet register"
    NAMES_A_ROUTE = "a run that stands for a train at rest names no route"
    TRAIN_MISSING = "a train of the fleet register has not told where it stands"
    BLOCK_HELD = "a train is held in the block"
    STILL_CLAIMED = "the run still holds a block"
    PROCEDURE_NOT_OPEN = "no supervised procedure is open for this train"
    STATEMENTS_DIFFER = "the two persons have stated different places"
    NO_STATEMENT = "the first person has not stated the same"
