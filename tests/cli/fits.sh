#!/usr/bin/env bash
# A garment of the wardrobe fits who wears it: it rests, nothing intersects, all its `expect`s hold (the strain among them), seams are
# closed to 0.1 mm, and left and right are alike where they were cut alike (`even`).
#   fits.sh PROGRAM SCRIPT RESULTS_FOLDER even|any [OPTION...]
set -u
program=$1 script=$2 out=$3 sides=$4
shift 4
command -v python3 >/dev/null || { echo "SKIPPED: python3 is not here to read report.json"; exit 77; }
"$program" run "$script" --no-pictures --no-checkpoint -o "$out" "$@" || exit 1
python3 - "$out/report.json" "$sides" <<'PY'
import json
import sys

report = json.load(open(sys.argv[1]))
drape = report["drape"]
wrong = []
if drape["status"] != "at rest":
    wrong.append("it is " + drape["status"])
for count in ("self_intersections", "body_intersections", "inside_body"):
    if drape[count] != 0:
        wrong.append(f"{count} {drape[count]}")
if not any("strain" in e["text"] for e in report["expects"]):
    wrong.append("the script expects nothing of the strain")
wrong += [f"{e['text']} is {e['shown']}" for e in report["expects"] if not e["passed"]]
wrong += [f"seam {s['name']} gapes by {1e3 * s['gap']:.3f} mm" for s in report["seams"] if not s["gap"] < 1e-4]
if sys.argv[2] == "even" and not drape["symmetric"]:
    wrong.append("left and right are not alike")
print("\n".join(wrong) or f"fits: strain {100 * report['garment']['strain']['largest']:.1f} %, {len(report['seams'])} seams closed")
sys.exit(1 if wrong else 0)
PY
