#!/usr/bin/env python3
"""Usage: busy.py CORES COMMAND…

Runs the command and prints which share of its cores' time its processes used: the time that their threads ran or were
ready to run, from /proc, at most CORES × seconds in each 20 ms. Time in which the machine ran others counts as used, since
a thread asked for it: so the figure is of use on a shared machine too. A process that has children only waits for them and
is not counted. What ends within 20 ms is missed.
"""
import subprocess
import sys
import time
from pathlib import Path


def leaves(process):
    """The process, or those of its descendants that have no children."""
    below = []
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        try:
            below += [leaf for child in task.read_text().split() for leaf in leaves(int(child))]
        except OSError:
            pass  # it has ended
    return below or [process]


def look(process, seen):
    """Seconds that threads ran, and ran or were ready to, since they were seen last."""
    ran = used = 0.0
    for leaf in leaves(process):
        for stat in Path(f"/proc/{leaf}/task").glob("*/schedstat"):
            try:
                on_core, waiting = (int(number) / 1e9 for number in stat.read_text().split()[:2])
            except (OSError, ValueError):
                continue
            before = seen.get(stat.parent.name, (on_core, waiting))
            seen[stat.parent.name] = on_core, waiting
            ran += on_core - before[0]
            used += on_core - before[0] + waiting - before[1]
    return ran, used


cores = int(sys.argv[1])
begin = now = time.monotonic()
process = subprocess.Popen(sys.argv[2:])
seen, ran, used = {}, 0.0, 0.0
while process.poll() is None:
    time.sleep(0.02)
    step, now = time.monotonic() - now, time.monotonic()
    ran_now, used_now = look(process.pid, seen)
    ran += ran_now
    used += min(used_now, cores * step)
wall = (now - begin) * cores
print(f"{now - begin:.2f} s on {cores} cores: {100 * used / wall:.1f} % used, of which it ran {100 * ran / wall:.1f} %")
