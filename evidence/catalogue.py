"""Every piece of evidence that a command produces, by its id."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from models.days.systems import NAMES as SYSTEMS
from models.reproduce import PAPERS
from models.shipped import shipped
from proofs.theories import THEORIES
from proofs.theory import Theory


@dataclass(frozen=True)
class Evidence:
    """One piece: what it shows, the command that makes it, and the file under ``out/`` that it stands in."""

    name: str
    shows: str
    command: str
    record: str


def catalogue() -> Mapping[str, Evidence]:
    """All of it, by id."""
    made = [
        *(
            Evidence(
                f"prove:{theory}.{claim}",
                _shows(each, claim),
                f"heisoku prove --solver both --only '^{theory}\\.'",
                "prove.json",
            )
            for theory, each in THEORIES.items()
            for claim in each.claimed
        ),
        *(
            Evidence(
                f"witness:{theory}",
                f"each transition of {theory} happens in some run, and does what it should",
                "make test",
                "test.xml",
            )
            for theory in THEORIES
        ),
        *(
            Evidence(f"check:{path.name}", f"{path.name} satisfies every axiom", "make check", "check.json")
            for path in sorted(shipped("layouts").glob("*.toml"))
        ),
        Evidence("ride", "machines on board against the truth of simulated trains", "make ride", "ride.json"),
        Evidence("beyond", "the same with faults beyond their declared ranges", "make beyond", "beyond.json"),
        *(
            Evidence(
                f"days:{system}",
                f"whole days of the {system} with faults, against the truth",
                f"heisoku days {system} --json out/days-{system}.json",
                f"days-{system}.json",
            )
            for system in SYSTEMS
        ),
        *(
            Evidence(
                f"reproduce:{paper}",
                f"the figures of paper {paper} beside ours",
                f"heisoku reproduce {paper} --json out/{paper}.json",
                f"{paper}.json",
            )
            for paper in PAPERS
        ),
        Evidence(
            "fuzz", "faulty traffic through the kernel, every invariant after each step", "make fuzz", "fuzz.json"
        ),
        Evidence(
            "certify",
            "each obligation with a proof whose every step was checked",
            "heisoku certify --json out/certificates.json",
            "certificates.json",
        ),
        Evidence("mutate", "what becomes of the proofs when a guard is dropped", "heisoku mutate", "mutate.json"),
        Evidence("crosshair", "contracts of machines on the bytecode that runs", "make crosshair", "crosshair.txt"),
        Evidence("test", "tests of the kernel, the lifter and everything else", "make test", "test.xml"),
    ]
    return {each.name: each for each in made}


def _shows(theory: Theory, claim: str) -> str:
    if claim in theory.promises:
        return f"no transition of {theory.name} leads away from `{claim}`, and each link's own leads on to it"
    return f"every transition of {theory.name} keeps `{claim}`, in every world that its assumptions allow"
