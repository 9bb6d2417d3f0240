"""What is random about a run, drawn once from the run's own generator (P1, P5, T16)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.sensors.faults import FAULTS, FIRST_OF_THEIR_OWN, Floats, drawn

Singles = npt.NDArray[np.float32]
Words = npt.NDArray[np.uint16]
Octets = npt.NDArray[np.int8]

NOISES = ("head", "left", "right", "yaw", "pitch", "tail_yaw")
"""The channels that have white noise in each cycle."""
WALKS = ("head", "left", "right", "yaw", "pitch", "tail_yaw")
"""The channels that drift: a step each second."""
CYCLES_A_STEP = 10


@dataclass(frozen=True)
class Chosen:
    """What is drawn first.

    ``values``: each parameter, shape (runs,).
    ``reads``: uniform in [0, 1), shape (runs, tags, 2): phase and errors of the reads.
    ``sources``: the runs' generators, from which the rest is drawn.
    """

    values: Mapping[str, Floats]
    reads: Floats
    sources: tuple[np.random.Generator, ...]


@dataclass(frozen=True)
class Draws:
    """All random numbers of some runs; the models only compute with them.

    ``values``: each parameter, shape (runs,).  ``walk``: standard normal, (runs, channels, seconds).
    ``sendings``: uniform 16 bits, (runs, cycles), for the telegrams.
    ``jitter``: uniform from -128 to 127, (runs, 2, cycles), for the clocks of head and tail.
    ``noise``: standard normal, (runs, channels, cycles).
    """

    values: Mapping[str, Floats]
    walk: Singles
    sendings: Words
    jitter: Octets
    noise: Singles


def generator(seed: int, run: int, *own: int) -> np.random.Generator:
    """The generator of one run, the same whatever other runs are made; ``own``: another one of the same run."""
    return np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(run, *own))))


def choose(
    seed: int,
    runs: Sequence[int],
    tags: int,
    beyond: Iterable[str] = (),
    present: Mapping[str, float] | None = None,
) -> Chosen:
    """Draw the parameters of some runs, each from its own generator.

    Raises:
        KeyError: ``beyond`` or ``present`` names no parameter.
    """
    uniforms, reads = np.empty((len(runs), len(FAULTS), 2)), np.empty((len(runs), tags, 2))
    sources = tuple(generator(seed, run) for run in runs)
    for row, (run, source) in enumerate(zip(runs, sources, strict=True)):
        source.random(out=uniforms[row, :FIRST_OF_THEIR_OWN])
        generator(seed, run, 1).random(out=uniforms[row, FIRST_OF_THEIR_OWN:])
        source.random(out=reads[row])
    return Chosen(drawn(uniforms, beyond, present), reads, sources)


def draw(chosen: Chosen, rows: slice, cycles: int) -> Draws:
    """Draw the rest for some of the runs: only once, since it uses their generators up."""
    sources = chosen.sources[rows]
    walk = np.empty((len(sources), len(WALKS), -(-cycles // CYCLES_A_STEP)), np.float32)
    sendings = np.empty((len(sources), cycles), np.uint16)
    jitter = np.empty((len(sources), 2, cycles), np.int8)
    noise = np.empty((len(sources), len(NOISES), cycles), np.float32)
    for row, source in enumerate(sources):
        source.standard_normal(out=walk[row], dtype=np.float32)
        sendings[row] = np.frombuffer(source.bytes(2 * cycles), np.uint16)
        jitter[row] = np.frombuffer(source.bytes(2 * cycles), np.int8).reshape(2, cycles)
        source.standard_normal(out=noise[row], dtype=np.float32)
    return Draws({name: value[rows] for name, value in chosen.values.items()}, walk, sendings, jitter, noise)
