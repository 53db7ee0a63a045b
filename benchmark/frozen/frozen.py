#!/usr/bin/env python3
"""Answers of the diagnosis, frozen: the same trials again must give the same numbers, to the last bit.

    benchmark/frozen/frozen.py            compares; names every trial that differs, status 1
    benchmark/frozen/frozen.py --write    freezes the present answers

For whoever changes how the search is written and not what it answers. Some minutes. Trials with one,
two and four hidden effects and with none, so that causes are added, merged, exchanged, dropped and
ranked. Other compilers round differently: freeze before a change and compare after it, on one machine.
No test of the suite: these are our own answers, not the truth; accuracy is measured by
`amb bench diagnosis`. The programs are those of build/release, or of the folder LEVITAS_BINARIES.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ANSWERS = HERE / "answers.json"
BINARIES = Path(os.environ.get("LEVITAS_BINARIES", ROOT / "build/release/bin"))
TRIALS = ("--pairs", "5", "--weak", "2", "--seeds", "4", "--clean", "1", "--bits", "700", "--first", "50000")
# Of the machine, not of the answer.
LEFT_OUT = ("seconds",)


def answers():
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "trials.json"
        subprocess.run([str(BINARIES / "amb-study"), "bench", "diagnosis", *TRIALS, "--jobs", "1", "--json", str(out)],
                       cwd=ROOT, check=True)
        trials = json.loads(out.read_text(encoding="utf-8"))["trials"]
    return {str(trial["seed"]): {key: value for key, value in trial.items() if key not in LEFT_OUT}
            for trial in trials}


def differences(frozen, now):
    for seed in sorted(frozen.keys() | now.keys()):
        before, after = frozen.get(seed, {}), now.get(seed, {})
        for key in sorted(before.keys() | after.keys()):
            if before.get(key) != after.get(key):
                yield f"{seed} {key}: {before.get(key)} was frozen, now {after.get(key)}"


def main():
    if sys.argv[1:] not in ([], ["--write"]):
        sys.exit(__doc__)
    now = answers()
    if sys.argv[1:]:
        ANSWERS.write_text(json.dumps(now, indent=1) + "\n", encoding="utf-8")
        print(f"wrote {ANSWERS.relative_to(ROOT)}: {len(now)} trials")
        return
    different = list(differences(json.loads(ANSWERS.read_text(encoding="utf-8")), now))
    print("\n".join(different) or f"{len(now)} trials, every number as frozen")
    sys.exit(1 if different else 0)


if __name__ == "__main__":
    main()
