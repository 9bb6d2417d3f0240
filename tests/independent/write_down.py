"""Write down what the enumeration finds: ``python -m tests.independent.write_down``.

To be run when a layout or the format changes, and the difference read before it is kept.
"""

from __future__ import annotations

import json

from tests.independent.files import EXPECTED, OTHERS, SAMPLES, path_of, to_write_down


def main() -> None:
    EXPECTED.mkdir(exist_ok=True)
    for name in (*SAMPLES, *OTHERS):
        if not path_of(name).exists():
            print(f"{name}: not there, left as it is")
            continue
        found = to_write_down(name)
        (EXPECTED / f"{path_of(name).stem}.json").write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
        print(f"{name}: {found['verdict']}, {len(found['violations'])} violations")


if __name__ == "__main__":
    main()
