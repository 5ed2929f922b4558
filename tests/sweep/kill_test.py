#!/usr/bin/env python3
"""Usage: kill_test.py PROGRAM FOLDER [KILLS [SEED [OPTION OF terrabench run…]]]

Kills runs and merges with SIGKILL at random moments, KILLS of each, and checks what is left. A program that ends before its
moment is started again and does not count.
- every line of measurements.jsonl that was whole at the kill is still there, and at most the last line is torn;
- `run --resume` exits with 0 and ends with the records and pictures of a run that was not killed;
- a killed merge leaves the old measurements.jsonl or the whole new one, with all pictures.
"""
import json
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

PROGRAM, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
KILLS = int(sys.argv[3]) if len(sys.argv) > 3 else 10
SEED = int(sys.argv[4]) if len(sys.argv) > 4 else 1
OPTIONS = sys.argv[5:]
ATTEMPTS = 3 * KILLS + 10
CASES = ["hybrid.noise-stages", "hybrid.fresnel", "--set", "pixels=16"]


def demand(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def terrabench(*arguments):
    """Runs the program to its end; returns what it wrote to standard error."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    demand(done.returncode == 0, f"{arguments}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stderr


def kill_after(seconds, folder, *arguments):
    """Starts the program and kills it; returns whether it still ran, and the whole lines just before."""
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(seconds)
    before = whole_lines(folder)
    process.kill()
    code = process.wait()
    demand(code in (0, -signal.SIGKILL), f"{arguments}: ended with {code} before its kill")
    return code != 0, before


def content(folder):
    file = folder / "measurements.jsonl"
    return file.read_bytes() if file.exists() else b""


def whole_lines(folder):
    text = content(folder)
    return text[: text.rfind(b"\n") + 1]


def results(folder):
    """What identifies and what was measured, but for times: case → exact figures and checksums of its pictures."""
    found = {}
    for line in content(folder).splitlines():
        record = json.loads(line)
        if record["kind"] != "record":
            continue
        exact = {m["name"]: m["samples"] for m in record["metrics"] if m["unit"] != "s" and not m["unit"].endswith("/s")}
        pictures = {f["file"]: f["checksum"] for f in record.get("figures", [])}
        for file in pictures:
            demand((folder / file).exists(), f"{folder}: {file} of {record['case']} is not there")
        found[record["experiment"], record["case"]] = exact, pictures
    return found


def count_records(folder):
    return whole_lines(folder).count(b'"kind":"record"')


def seconds_of(*arguments):
    begin = time.monotonic()
    terrabench(*arguments)
    return time.monotonic() - begin


def seconds_left(folder, *arguments):
    """Runs the program to its end; returns, for each number of records, how long it still ran once it had written them."""
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    begin, appeared = time.monotonic(), []
    while process.poll() is None:
        appeared += [time.monotonic()] * (count_records(folder) + 1 - len(appeared))
        time.sleep(0.001)
    end = time.monotonic()
    demand(process.returncode == 0, f"{arguments}: exit code {process.returncode}")
    appeared += [end] * (count_records(folder) + 1 - len(appeared))
    return [end - begin] + [end - moment for moment in appeared[1:]]


def kill_runs(moments):
    whole, killed = FOLDER / "whole", FOLDER / "killed"
    run = ["run", *CASES, *OPTIONS, "--out"]
    left = seconds_left(whole, *run, whole)
    start = seconds_of(*run, whole, "--resume")  # nothing remains to be measured
    expected = results(whole)
    demand(len(left) == len(expected) + 1, f"{len(left) - 1} records were counted, {len(expected)} were read")
    attempts = hits = torn = completed = 0
    while hits < KILLS and attempts < ATTEMPTS:
        attempts += 1
        done = count_records(killed)
        seconds = left[0] if done == 0 else start + left[done]
        earlier = content(killed)
        hit, before = kill_after(moments.uniform(0, seconds), killed, *run, killed, "--resume")
        hits += hit
        demand(content(killed).startswith(before), f"attempt {attempts}: a line that was whole is gone")
        torn += content(killed) not in (earlier, whole_lines(killed))
        for line in whole_lines(killed).splitlines():
            json.loads(line)
        # Two of three are killed again before they are complete, as long as any case remains.
        if not hit or hits % 3 == 0 or hits == KILLS or count_records(killed) == len(expected):
            said = terrabench(*run, killed, "--resume")
            demand("altered" not in said, said)
            demand(results(killed) == expected, f"attempt {attempts}: the resumed run has other results")
            terrabench("compare", whole, killed)
            completed += 1
            shutil.rmtree(killed)
    demand(hits == KILLS, f"only {hits} of {attempts} runs were killed before they ended")
    print(f"runs: {hits} kills while it ran, of {attempts} attempts over {left[0]:.1f} s, {torn} left a torn line, "
          f"{completed} times completed with the same {len(expected)} records")


def kill_merges(moments):
    old, new, out, shards = FOLDER / "old", FOLDER / "new", FOLDER / "out", []
    for i in (1, 2, 3):
        shards.append(FOLDER / f"shard{i}")
        terrabench("run", *CASES, "--shard", f"{i}/3", "--out", shards[-1])
    shutil.copytree(shards[0], old)
    shutil.copytree(old, new)
    seconds = seconds_of("merge", new, *shards[1:])
    attempts = hits = came_through = 0
    while hits < KILLS and attempts < ATTEMPTS:
        attempts += 1
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(old, out)
        hit, _ = kill_after(moments.uniform(0.2, 1) * seconds, out, "merge", out, *shards[1:])
        hits += hit
        left = content(out)
        demand(left in (content(old), content(new)), f"attempt {attempts}: neither the old nor the new records")
        came_through += hit and left == content(new)
        results(out)
        terrabench("merge", out, *shards[1:])
        demand(content(out) == content(new), f"attempt {attempts}: the repeated merge has other records")
        demand(results(out) == results(FOLDER / "whole"), f"attempt {attempts}: not the results of the unbroken run")
    demand(hits == KILLS, f"only {hits} of {attempts} merges were killed before they ended")
    print(f"merges: {hits} kills while it ran, of {attempts} attempts over {seconds:.2f} s, {came_through} left the new "
          f"records, {hits - came_through} the old")


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
kill_runs(random.Random(SEED))
kill_merges(random.Random(SEED))
