#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""How long a large study takes, from the runs of it that are finished: a schedule is simulated with their measured times.

usage: plan-study.py FOLDER --runs N --slots M [--tasks T] [--start S] [--failures-per-day F] [--checkpoint S]

FOLDER has some finished runs (treadmark sweep ... --runs 1-100), best of all kinds that there are. How long each took is the age of its store against
its lock, so that runs which were interrupted count too long. N runs with times drawn from these are shared out to T tasks, which M slots
(processes that run at the same time) take one after the other; S seconds pass before the first run of a task. A slot that fails loses at
most a checkpoint, and its task is begun again at the end of the queue. Prints a table: wall clock, use of the slots, storage.
"""
import argparse
import heapq
import pathlib
import random
import sys


def measured(folder):
    """(seconds, bytes) of each finished run."""
    runs = []
    for store in sorted(folder.glob("runs/*/simulation.h5")):
        seconds = store.stat().st_mtime - (store.parent / "lock").stat().st_mtime
        runs.append((max(seconds, 0.0), sum(file.stat().st_size for file in store.parent.iterdir())))
    return runs


def schedule(times, tasks, slots, start=0.0, failures=0.0, checkpoint=0.0, seed=1):
    """(wall clock, busy slot seconds) of runs with these times in tasks of equal numbers. failures: of a slot in a second."""
    chance = random.Random(seed)
    share = -(-len(times) // tasks)
    queue = [times[first:first + share] for first in range(0, len(times), share)][::-1]
    free, now, busy = [0.0] * min(slots, len(queue)), 0.0, 0.0
    heapq.heapify(free)
    end = 0.0
    while queue:
        now = heapq.heappop(free)
        work = queue.pop()
        whole = start + sum(work)
        lived = chance.expovariate(failures) if failures > 0.0 else float("inf")
        if lived < whole:
            # What is left, with the part of the run at hand since the last checkpoint.
            done, left = start, list(work)
            while left and done + left[0] <= lived:
                done += left.pop(0)
            if left and lived > start:
                kept = max(0.0, lived - done - checkpoint)
                left[0] -= min(kept, left[0])
            queue.insert(0, left)
            whole = lived
        busy += whole
        end = max(end, now + whole)
        heapq.heappush(free, now + whole)
    return end, busy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, required=True)
    parser.add_argument("--slots", type=int, required=True)
    parser.add_argument("--tasks", type=int, help="default: 100, 300, 1000 and a run each, beside each other")
    parser.add_argument("--start", type=float, default=1.0)
    parser.add_argument("--failures-per-day", type=float, default=0.0, help="of a slot")
    parser.add_argument("--checkpoint", type=float, default=10.0)
    options = parser.parse_args()
    found = measured(options.folder)
    if len(found) < 2:
        sys.exit(f"{options.folder} has fewer than two finished runs: solve some with treadmark sweep STUDY -o {options.folder} --runs 1-50")
    chance = random.Random(0)
    drawn = [chance.choice(found) for _ in range(options.runs)]
    times, size = [run[0] for run in drawn], sum(run[1] for run in drawn)
    print(f"measured: {len(found)} runs, {sum(run[0] for run in found) / len(found):.3g} s each ({min(found)[0]:.3g} to {max(found)[0]:.3g})")
    print(f"{options.runs} runs: {sum(times) / 3600:.4g} hours of one slot, {size / 1e9:.3g} GB in {3 * options.runs} files and folders")
    print("   tasks  wall clock [h]  slots in use")
    for tasks in [options.tasks] if options.tasks else sorted({min(n, options.runs) for n in (100, 300, 1000, options.runs)}):
        wall, _ = schedule(times, tasks, options.slots, options.start, options.failures_per_day / 86400, options.checkpoint)
        print(f"{tasks:8}  {wall / 3600:14.3f}  {100 * sum(times) / (wall * options.slots):10.1f} %")


if __name__ == "__main__":
    main()
