# SPDX-License-Identifier: BSD-3-Clause
"""Runs of a study that is repeated: one that is complete is not run again."""
import json
import subprocess


def summaryOf(out):
    """The summary of a complete run in folder `out`, else None."""
    path = out / "summary.json"
    if not path.exists():
        return None
    summary = json.loads(path.read_text(encoding="utf-8"))
    return summary if summary["status"] == "completed" else None


def completedRun(harmos, deck, out, settings=None):
    """The summary of `deck` with deck keys `settings` in folder `out`; RuntimeError with the program's message where it fails."""
    summary = summaryOf(out)
    if summary:
        return summary
    out.parent.mkdir(parents=True, exist_ok=True)
    words = [word for key, value in (settings or {}).items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run([harmos, "run", deck, "--output", out, "--force", *words], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{out.name}: {done.stderr.strip()}")
    return summaryOf(out)
