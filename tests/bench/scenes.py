#!/usr/bin/env python3
"""Runs the bench scenes (tests/bench/scenes) and prints what each costs and what came out.

  tests/bench/scenes.py PROGRAM [--only WORD ...] [--large] [--threads N] [--json FILE]

Motions run for 2 s at 60 frames a second, circle skirts until rest. `cpu` and `wall` are seconds of the whole program, `strain` the
largest tensile strain and its 99th percentile, `cut` the intersections and particles inside a body by the exact test.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes")

# name, script, parameters, other options, only with --large
SCENES = [
    ("square on ball 50", "square_on_ball", {"n": 50}, [], False),
    ("square on ball 100", "square_on_ball", {"n": 100}, [], False),
    ("square on ball 200", "square_on_ball", {"n": 200}, [], True),
    ("square on ball 50, no self-collision", "square_on_ball", {"n": 50}, ["--no-self-collision"], False),
    ("square on ball 100, no self-collision", "square_on_ball", {"n": 100}, ["--no-self-collision"], False),
    ("square on ball 200, no self-collision", "square_on_ball", {"n": 200}, ["--no-self-collision"], True),
    ("hanging 50", "hanging_square", {"n": 50}, [], False),
    ("hanging 100", "hanging_square", {"n": 100}, [], False),
    ("hanging 200", "hanging_square", {"n": 200}, [], True),
    ("tube skirt 120 x 80", "tube_skirt", {"n": 120}, [], False),
] + [
    (f"circle skirt {particles}, {stiffness} N/m{', preview' if 'preview' in script else ''}", script,
     {"particles": particles, "stiffness": f"{stiffness}N/m"}, [], particles > 10000)
    for script in ("circle_skirt_preview", "circle_skirt")
    for stiffness in ((400,) if "preview" in script else (400, 4000))
    for particles in (2500, 10000, 40000)
]


def run(program, scene, threads, folder):
    name, script, parameters, options, _ = scene
    out = os.path.join(folder, "out")
    shutil.rmtree(out, ignore_errors=True)
    command = [program, "run", os.path.join(HERE, script + ".garment"), "--quiet", "--no-pictures", "--out", out,
               "--threads", str(threads)] + options
    for key, value in parameters.items():
        command += ["-p", f"{key}={value}"]
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    errors = process.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - start
    row = {"scene": name, "threads": threads, "wall_s": wall, "cpu_s": usage.ru_utime + usage.ru_stime,
           "memory_mib": usage.ru_maxrss / 1024, "exit": os.waitstatus_to_exitcode(status)}
    try:
        with open(os.path.join(out, "report.json")) as file:
            report = json.load(file)
    except OSError:
        row["error"] = errors.strip().splitlines()[-1] if errors.strip() else "no report"
        return row
    drape, cloth = report["drape"], report["garment"]
    row.update(particles=report["particles"], steps=drape["steps"], status=drape["status"],
               strain=cloth["strain"]["largest"], strain_p99=cloth["strain"]["p99"],
               cut=drape["self_intersections"] + drape["body_intersections"] + drape["inside_body"],
               residual=drape["residual_over_weight"], hash=report["state_hash"])
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--only", action="append", default=[], help="scenes whose name has this word")
    parser.add_argument("--large", action="store_true", help="also 40,000 particles")
    parser.add_argument("--threads", type=int, action="append", help="default: 1 and 2")
    parser.add_argument("--json", help="also write the rows to this file")
    options = parser.parse_args()
    rows = []
    print(f"{'scene':40} {'thr':>3} {'wall s':>7} {'cpu s':>7} {'MiB':>5} {'particles':>9} {'steps':>5} {'strain':>7} {'p99':>7} "
          f"{'cut':>4} {'residual':>8}  state hash")
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            if (scene[4] and not options.large) or not all(word in scene[0] for word in options.only):
                continue
            for threads in options.threads or (1, 2):
                row = run(options.program, scene, threads, folder)
                rows.append(row)
                head = f"{row['scene']:40} {threads:3} {row['wall_s']:7.2f} {row['cpu_s']:7.2f} {row['memory_mib']:5.0f} "
                if "error" in row:
                    print(head + row["error"])
                else:
                    print(head + f"{row['particles']:9} {row['steps']:5} {100 * row['strain']:6.2f}% {100 * row['strain_p99']:6.2f}% "
                          f"{row['cut']:4} {row['residual']:8.3f}  {row['hash']}" + ("" if row["exit"] in (0, 4) else f"  exit {row['exit']}"))
                sys.stdout.flush()
    if options.json:
        with open(options.json, "w") as file:
            json.dump(rows, file, indent=1)
    return 1 if any(row["exit"] != 0 for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
