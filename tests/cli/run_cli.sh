#!/usr/bin/env bash
# Runs the program as a user does, and looks at what it prints, writes and returns.
#   run_cli.sh PROGRAM SOURCE_DIR
set -u
program=$1
here=$2/tests/cli
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

failures=0
checks=0
fail() {
  failures=$((failures + 1))
  echo "FAILED: $*"
  sed 's/^/    out: /' out.txt 2>/dev/null | head -20
  sed 's/^/    err: /' err.txt 2>/dev/null | head -20
}
ok() { checks=$((checks + 1)); }

# run EXPECTED_EXIT_CODE ARGUMENT...: standard output in out.txt, standard error in err.txt
run() {
  local expected=$1
  shift
  "$program" "$@" >out.txt 2>err.txt </dev/null
  local code=$?
  ok
  [ $code -eq "$expected" ] || fail "\`garment $*\` returned $code, expected $expected"
}
says() { ok; grep -qF -- "$1" out.txt || fail "standard output does not say: $1"; }
complains() { ok; grep -qF -- "$1" err.txt || fail "standard error does not say: $1"; }
silent() { ok; [ ! -s "$1" ] || fail "$1 should be empty"; }
exists() { ok; [ -s "$1" ] || fail "$1 is missing or empty"; }
absent() { ok; [ ! -e "$1" ] || fail "$1 should not be there"; }
no_leftovers() { ok; [ -z "$(find "$1" -name '*.tmp' 2>/dev/null)" ] || fail "half-written files below $1"; }

# json EXPRESSION FILE: the value of an expression on the parsed file, written for both languages
if command -v python3 >/dev/null && python3 -c '' 2>/dev/null; then
  parses() { python3 -c 'import json,sys; json.load(open(sys.argv[1]))' "$1" 2>/dev/null; }
elif command -v node >/dev/null; then
  parses() { node -e 'JSON.parse(require("fs").readFileSync(process.argv[1]))' "$1" 2>/dev/null; }
else
  echo "SKIPPED: neither python3 nor node is here; that --json parses was not looked at"
  parses() { return 0; }
fi
is_json() { ok; parses "$1" || fail "$1 is not JSON"; }
# The first value of a key in a JSON file, as text.
value_of() { grep -o "\"$1\": *[^,}]*" "$2" | head -1 | sed 's/^[^:]*: *//; s/"//g'; }

cp "$here/square.garment" "$here/slow.garment" .

# ---- help and version
run 0 --help
says "examples:"
says "exit codes: 0 ok, 1 diagnostics, 2 usage"
silent err.txt
for command in run check model parse fmt import export measure test explain; do
  run 0 $command --help
  says "Usage: garment $command"
done
run 0 --version
says "garment "

# ---- usage
run 2
run 2 knit skirt.garment
run 2 run
run 2 run square.garment --sparkle
run 2 run square.garment --threads 0
run 2 check square.garment -p wide
complains "error[G1001]"
run 2 explain G9999
complains "is no diagnostic code"

# ---- explain
run 0 explain G0501
says "G0501: the sides of a seam do not have the same length"
says "What to do:"
run 0 explain g501 G0505
says "G0501: the sides of a seam"
says "G0505: an edge left unsewn"
run 0 explain seam length
says "seam NAME: SIDE to SIDE"
says "length("
run 0 explain gather
says "clause of"
run 2 explain G0502
complains "did you mean \`G05"
run 2 explain seem G0501
complains "did you mean \`seam\`"
says "G0501: the sides of a seam"
run 2 explain
complains "--list"
run 0 explain --list
says "G0312  something is missing in a statement"
run 0 explain G0501 --json
is_json out.txt

# ---- reference
run 0 reference
ok
cmp -s out.txt "$2/docs/reference.md" || fail "docs/reference.md is old: garment reference > docs/reference.md"

# ---- check
run 0 check square.garment
silent out.txt
complains "square.garment: ok, 1 panel, 0 seams"
run 0 check square.garment -q
silent err.txt
run 0 check square.garment --json
is_json out.txt
printf 'garment 1 "wrong"\nlet w = 20 cm + 3\n' >wrong.garment
run 1 check wrong.garment
silent out.txt
complains "error[G0305]"
complains "wrong.garment:2:9"
run 1 check wrong.garment --json
is_json out.txt
says '"G0305"'
silent err.txt
run 3 check nobody.garment
complains "error[G0901]"
complains "nobody.garment"
run 3 check .
complains "error[G0901]"
: >empty.garment
run 1 check empty.garment
complains "the garment has no panels"

# ---- check --model also builds what a run would build
sed 's/^place cloth.*/place cloth at (0, 1 m, 0)/; s/to (30 cm, 0)/to (30 cm, 0)/' square.garment >checked.garment
run 0 check checked.garment --model

# ---- libraries are looked for in the folders of --library first
mkdir -p trims more_trims
printf 'let tape = 2 cm\n' >trims/trims.garment
printf 'let tape = 3 cm\nlet cord = 4 mm\n' >more_trims/trims.garment
printf 'let cord = 5 mm\n' >more_trims/cords.garment
{ printf 'use trims, cords\nassert trims.tape == 2 cm\nassert cords.cord == 5 mm\n'; grep -v '^garment' square.garment; } >trimmed.garment
run 1 check trimmed.garment
complains "error[G0318]"
run 0 check trimmed.garment --library trims --library more_trims
run 1 check trimmed.garment --library more_trims --library trims
complains "error[G0320]"

# ---- a question before any drape; a drape for a time
sed 's/^drape.*//' square.garment >undraped.garment
run 1 check undraped.garment
complains "error[G0325]"
sed 's/^drape.*/drape for 2 s/' square.garment >timed.garment
run 0 check timed.garment
ok

# ---- parameters
run 0 model square.garment
cp out.txt model.txt
says "particles"
run 0 model square.garment -p wide=20cm
ok
cmp -s out.txt model.txt && fail "-p wide=20cm changed nothing"
run 1 check square.garment -p wide=3m
complains "error[G0310]"
run 1 check square.garment -p wdie=20cm
complains "error[G0324]"
complains "wide"
run 1 check square.garment -p wide=20
complains "error[G0308]"
run 0 model square.garment --json
is_json out.txt

# ---- parse and fmt
run 0 parse square.garment
says "panel"
run 0 parse square.garment --json
is_json out.txt
printf 'let w = 2 *\n' >cut.garment
run 1 parse cut.garment
complains "error[G0206]"
run 0 fmt --check square.garment
printf 'garment 1   "loose"\nlet   w=20   cm\n' >loose.garment
run 1 fmt --check loose.garment
run 0 fmt --stdout loose.garment
says "let w = 20 cm"
run 0 fmt loose.garment
run 0 fmt --check loose.garment
run 3 fmt nobody.garment
mkdir -p layout/inner nothing
printf 'let   w=20   cm\nlet v = 3 cm\n' >layout/a.garment
printf 'let w = 20 cm\n' >layout/inner/b.garment
run 1 fmt --check layout
complains "layout/a.garment is not laid out"
run 1 fmt --diff layout
says "@@ -1,2 +1,2 @@"
says "-let   w=20   cm"
says "+let w = 20 cm"
if command -v patch >/dev/null; then
  ok
  cp layout/a.garment patched.garment
  patch -s patched.garment out.txt && "$program" fmt --check patched.garment || fail "the diff of fmt is no patch"
fi
run 0 fmt layout square.garment
run 0 fmt --check layout square.garment
run 0 fmt --diff layout
silent out.txt
run 3 fmt nothing
complains "error[G0904]"
ok
[ "$(printf 'let   w=20   cm\n' | "$program" fmt -)" = "let w = 20 cm" ] || fail "fmt - does not lay out standard input"
ok
printf 'let w = (\n' | "$program" fmt - >out.txt 2>err.txt && fail "fmt - accepts a broken script"
complains "standard input:1:9"

# ---- run
run 0 run square.garment --no-pictures
complains "at rest"
complains "results in square/"
for file in garment.obj garment.glb pattern.svg report.json; do exists square/$file; done
absent square/drape.png
no_leftovers square
is_json square/report.json
ok
LC_ALL=C grep -q $'[\r\x1b]' err.txt && fail "piped progress holds carriage returns or escapes"
run 0 run square.garment --no-pictures --json -o json_out
is_json out.txt
run 0 run square.garment --no-pictures -q -o quiet_out
silent out.txt
silent err.txt
run 0 run square.garment -o pictures_out
exists pictures_out/drape.png
ok
[ "$(head -c 4 pictures_out/drape.png | tail -c 3)" = PNG ] || fail "drape.png is no PNG"
run 0 run square.garment --no-pictures --ply -p wide=12cm -o ply_out
exists ply_out/garment.ply
ok
grep -q 'wide' ply_out/report.json || fail "the report does not tell the parameter that was set"

# ---- the same bits for any number of threads, and again
for threads in 1 2 4; do
  run 0 run square.garment --no-pictures -q --threads $threads -o threads_$threads
done
hash=$(value_of state_sha256 threads_1/report.json)
[ -n "$hash" ] || hash=$(value_of state_hash threads_1/report.json)
ok
[ ${#hash} -ge 16 ] || fail "report.json holds no state hash"
for threads in 2 4; do
  ok
  grep -q "$hash" threads_$threads/report.json || fail "--threads $threads gives another state than --threads 1"
  ok
  cmp -s threads_1/garment.obj threads_$threads/garment.obj || fail "--threads $threads writes another garment.obj"
done

# ---- exit codes of a drape
sed 's/expect penetrations == 0/expect strain(cloth) > 90%/' square.garment >expects.garment
run 5 run expects.garment --no-pictures
complains "G0331"
exists expects/garment.obj
run 4 run slow.garment --no-pictures --max-steps 1 -o hurried
complains "error[G0802]"
complains "how the garment lies then is written to \`hurried/garment.obj\`"
exists hurried/garment.obj
is_json hurried/report.json
# With --json the report and the diagnostics are one document.
run 4 run slow.garment --no-pictures --max-steps 1 -o hurried --json
is_json out.txt
grep -q '"G0802"' out.txt || fail "the document of a failed run does not hold its diagnostic"
run 1 run wrong.garment --json
is_json out.txt
sed 's/^drape.*/record curve elapsed, position(one).y every 25 ms as "fall.csv"\nrecord frames every 50 ms as "shapes\/fall.obj"\ndrape for 100 ms/; /^expect/d' \
  square.garment >timed.garment
run 0 run timed.garment --no-pictures -o timed_out
complains "ran for its time"
[ "$(wc -l <timed_out/fall.csv)" -eq 6 ] || fail "a curve of 100 ms every 25 ms has not five rows"
[ "$(ls timed_out/shapes | wc -l)" -eq 3 ] || fail "100 ms every 50 ms are not three frames"
grep -q '"numerical"' timed_out/report.json || fail "the report of a motion has no balance of energy"
sed 's/^expect.*/save "cloth.obj"/' square.garment >saves.garment
run 0 run saves.garment --no-pictures -o saves_out
exists saves_out/cloth.obj
sed 's/^expect.*/save "cloth.docx"/' square.garment >saves.garment
run 1 check saves.garment
complains "error[G0905]"

# ---- measures of bodies
cat >worn.garment <<'EOT'
garment 1 "worn"
use fabrics, bodies
body form = bodies.woman(size: 40)
panel cloth of fabrics.linen {
  outline circle((0, 0), 5 cm) free
}
place cloth at (2 m, 1 m, 0)
save "worn.pdf"
EOT
run 0 run worn.garment --no-pictures -o worn_out --paper A3
exists worn_out/body.obj
exists worn_out/worn.pdf
run 2 run worn.garment --paper A44
complains "no paper"
run 0 measure worn_out/body.obj --picture measured.png
says "stature                          168.0"
says "back_length"
exists measured.png
no_leftovers .
run 0 measure worn_out/body.obj --json
is_json out.txt
run 0 measure worn_out/body.obj --csv --unit mm
says "body,measure,height [mm],size [mm]"
cp out.txt straight.csv
run 0 measure worn.garment
says "stated"
# The same body in millimetres along z, looking back.
awk '/^v /{print "v", -$2*1000, $4*1000, $3*1000; next} /^v[nt]/{next} {print}' worn_out/body.obj >turned.obj
run 0 measure turned.obj --csv --unit mm
complains "note[G0715]"
complains "note[G0716]"
sed 's/^[^,]*,//' out.txt >turned.txt
sed 's/^[^,]*,//' straight.csv >straight.txt
ok
paste -d, straight.txt turned.txt | awk -F, 'NR > 1 && (($2 - $5)^2 > 1 || ($3 - $6)^2 > 1 || $1 != $4) {bad = 1} END {exit bad}' || fail "a turned body has other measures"
awk '/^f /{if (++n % 900 == 5) next} {print}' worn_out/body.obj >torn.obj
run 0 measure torn.obj
complains "note[G0718]"
awk '/^v /{high[++n] = $4 < -9 || $3 > 1.46} /^f /{for (k = 2; k <= NF; ++k) {split($k, i, "/"); if (high[i[1]]) next}} {print}' worn_out/body.obj >headless.obj
run 0 measure headless.obj
complains "note[G0717]"
awk '/^v /{far[++n] = ($2 > 0.24 || $2 < -0.24) && $3 > 0.7} /^f /{for (k = 2; k <= NF; ++k) {split($k, i, "/"); if (far[i[1]]) next}} {print}' worn_out/body.obj >armless.obj
run 0 measure armless.obj
complains "note[G0719]"
printf 'v 0 0 0\nv 1 0 0\nv 0 1.7 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >wedge.obj
run 1 measure wedge.obj
complains "error[G0714]"
run 3 measure nobody.obj
complains "error[G0901]"

# ---- a table of the drape, and formats still to come
sed 's/^expect.*/save "cloth.csv"/' square.garment >saves.garment
run 0 run saves.garment --no-pictures -o saves_out
ok
grep -q '^cloth,' saves_out/cloth.csv || fail "the table has no row of the panel"
sed 's/^expect.*/save "cloth.vtk"/' square.garment >saves.garment
run 1 check saves.garment
complains "cannot be written yet"

# ---- release: the cloth that hung from two corners swings down to hang from one
sed 's/^expect.*/release two\ndrape until rest settle preview\nexpect position(two).y < 1.06 m\nexpect position(one).y == 1.1 m within 1 mm/' \
  square.garment >released.garment
run 0 run released.garment --no-pictures -o released_out
# ---- a layer at rest on the wrong side: what comes after the drape is done, and the exit code is that of an `expect` that failed
cp "$2/tests/golden/run/lining_outside.garment" outside.garment
echo 'save "outside.obj"' >>outside.garment
run 5 run outside.garment --no-pictures -o outside_out
complains "warning[G0609]: \`lining\` is declared under \`front\`, but starts over it"
complains "error[G0811]: \`lining\` is declared under \`front\`, but came to rest over it"
exists outside_out/outside.obj
ok
grep -q '"G0811"' outside_out/report.json || fail "the report does not hold what is wrong"
grep -v '^drape' outside.garment >flat.garment
run 0 check --model flat.garment
ok
grep -q 'G0609' err.txt && fail "a start is told that nothing drapes"

# ---- a study: a round for each value, side by side
{ grep -v '^drape\|^expect' square.garment
  echo 'vary wide over 8 cm, 12 cm { drape until rest settle preview; expect mass < 1 kg; save "cloth.obj" }'; } >study.garment
run 0 check study.garment
run 0 run study.garment --no-pictures -o study_out
exists study_out/wide=8cm/cloth.obj
exists study_out/wide=12cm/report.json
ok
[ "$(grep -c 'at_rest\|at rest' study_out/study_wide.csv)" -eq 2 ] || fail "the table of the study has not two rows: $(cat study_out/study_wide.csv)"
ok
cmp -s study_out/wide=8cm/cloth.obj study_out/wide=12cm/cloth.obj && fail "both rounds are the same"
# All rounds speak of the same lines: what goes wrong in one of them names it.
mkdir rounds
sed 's/mass < 1 kg/area(cloth) < 110 cm^2/' study.garment >rounds/study.garment
run 1 test rounds
says '`area(cloth) < 110 cm^2` does not hold, in the round wide = 12 cm'
ok
grep -q 'round wide = 8 cm' out.txt && fail "a round that holds is told"
# What the script measures is asked in each round and stands in the table; a list gives its numbers.
sed 's/over 8 cm, 12 cm/over steps(8 cm .. 12 cm, 2 cm)/' study.garment >study_list.garment
echo 'measure heavy = mass(cloth)' >>study_list.garment
run 0 run study_list.garment --no-pictures -o study_list
head -1 study_list/study_wide.csv | grep -q ',heavy \[kg\],' || fail "the table of the study lacks the measure: $(cat study_list/study_wide.csv)"
ok
[ "$(grep -c 'at rest' study_list/study_wide.csv)" -eq 3 ] || fail "steps() gives not three rounds: $(cat study_list/study_wide.csv)"
ok
# A question before any drape is refused before anything is draped.
{ cat study.garment; echo 'expect mass < 1 kg'; } >early.garment
run 1 run early.garment --no-pictures -o early
complains "G0325"
[ ! -e early/study_wide.csv ] || fail "a script with a question before any drape was run"
ok
# A library is checked as one: it has no panels of its own, and others use its names.
run 0 check "$2/stdlib/blocks.garment"
grep -q 'ok, a library' out.txt err.txt || fail "a library is not known as one"
ok
grep -q 'G1225\|G0439\|G0452' err.txt && fail "names of a library count as unused"
ok
# Many things that cannot be modelled yet are one warning to a person, each its own to a program.
{ cat square.garment | sed '/^drape/,$d'; for k in p1 p2 p3 p4; do echo "pad $k on cloth at (5 cm, 5 cm) radius 2 cm thickness 5 mm side face"; done; echo 'drape until rest'; } >padded_face.garment
run 0 check padded_face.garment
[ "$(grep -c G0460 err.txt)" -eq 1 ] || fail "what cannot be modelled is told more than once"
ok
run 0 check padded_face.garment --json
[ "$(grep -c '"G0460"' out.txt)" -ge 4 ] || fail "what cannot be modelled is drawn together in JSON too"
ok
run 0 check "$2/examples/lined_skirt.garment"
grep -q G0460 err.txt && fail "something of the lined skirt cannot be modelled"
ok
sed 's/12 cm/120 cm/' study.garment >study_wrong.garment
run 1 check study_wrong.garment
complains "error[G0310]"
complains "wide = 120 cm"

# ---- places that cannot be written (also by root: a folder below a plain file)
: >plain_file
run 3 run square.garment --no-pictures -o plain_file/out
complains "error[G0902]"
complains "-o"
ok
[ "$(grep -c 'error\[' err.txt)" -eq 1 ] || fail "one unwritable folder is told more than once"
ok
[ -f plain_file ] && [ ! -s plain_file ] || fail "the plain file was changed"
run 3 fmt plain_file/x.garment

# ---- Ctrl-C: the state reached is written, the exit code says so
"$program" run slow.garment --no-pictures --threads 1 -o stopped >out.txt 2>err.txt </dev/null &
pid=$!
sleep 1
kill -INT $pid
wait $pid
code=$?
ok
[ $code -eq 130 ] || fail "SIGINT: returned $code, expected 130"
exists stopped/garment.obj
exists stopped/report.json
is_json stopped/report.json
no_leftovers stopped
ok
grep -q interrupted stopped/report.json || fail "the report does not say that the drape was interrupted"

# ---- specifications
cp "$2/tests/unit/io/fixtures/"*.json . 2>/dev/null
spec=$(ls ./*.json 2>/dev/null | head -1)
if [ -n "$spec" ]; then
  run 1 run "$spec"
  complains "error[G1002]"
  run 0 model "$spec"
  run 0 check "$spec"
  run 0 import "$spec" -o imported.garment
  exists imported.garment
  run 3 import "$spec" -o imported.garment
  complains "error[G0903]"
  run 0 import "$spec" -o imported.garment --force
  run 3 import "$spec" -o plain_file/imported.garment
  complains "error[G0902]"
  run 0 fmt --check imported.garment
  # Back again: from the specification, and by way of the script.
  run 0 import "$spec" -o again.json
  run 0 export "$spec" -o at_once.json
  run 0 export imported.garment -o by_script.json
  for made in again at_once by_script; do
    python3 - "$spec" "$made.json" <<'PY' || fail "$made.json is not $spec"
import json, sys
def same(a, b):
    if isinstance(a, (int, float)) and isinstance(b, (int, float)): return abs(a - b) <= 1e-6
    if isinstance(a, dict) and isinstance(b, dict): return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, list) and isinstance(b, list): return len(a) == len(b) and all(map(same, a, b))
    return a == b
sys.exit(not same(*(json.load(open(f)) for f in sys.argv[1:3])))
PY
  done
fi
# ---- pieces in DXF
cat >piece.garment <<'END'
garment 1 "pieces"
fabric poplin = { W = 0.12 kg/m^2 }
panel disc of poplin { outline circle((0, 0), 12 cm) }
panel front of poplin {
  outline from (0, 0) {
    edge hem to (30 cm, 0) free
    edge side to (27 cm, 60 cm) through (31 cm, 20 cm), (29 cm, 45 cm) free
    edge neck to (0, 52 cm) control (10 cm, 50 cm) free
    close middle free
  }
  allowance 1 cm
  notch hip on side at 20 cm
}
measure round_area = area(disc)
measure front_area = area(front)
END
run 0 export piece.garment -o piece.dxf
run 0 import piece.dxf -o piece_again.garment
complains "2 panels"
run 0 check piece_again.garment
run 0 import piece.dxf --sizes
says "BASE"
printf 'AutoCAD Binary DXF\r\n' >binary.dxf
run 1 import binary.dxf -o binary.garment
complains "error[G0960]"
if /usr/bin/python3 -c 'import ezdxf' 2>/dev/null; then
  run 0 check piece.garment --json
  /usr/bin/python3 - piece.dxf out.txt <<'PY' || fail "ezdxf reads other areas in piece.dxf"
import json, sys, ezdxf
stated = {m["name"]: m["value"] for m in json.load(open(sys.argv[2]))["measures"]}
areas = {}
for block in ezdxf.readfile(sys.argv[1]).blocks:
    for line in block.query("POLYLINE"):
        p = [v.dxf.location for v in line.vertices]
        area = abs(sum(p[i - 1].x * p[i].y - p[i].x * p[i - 1].y for i in range(len(p)))) / 2e6
        areas[block.name, line.dxf.layer] = area
stitch = {"round_area": areas["DISC", "1"], "front_area": areas["FRONT", "14"]}
sys.exit(any(abs(stitch[k] / stated[k] - 1) > 1e-4 for k in stitch) or not areas["FRONT", "1"] > areas["FRONT", "14"])
PY
  # Curves of other systems: ezdxf draws pieces of splines, ellipses, arcs and bulges and says their areas.
  /usr/bin/python3 - curved.dxf curved.json <<'PY' || fail "ezdxf does not write curved.dxf"
import json, math, sys, ezdxf
from ezdxf.math import Vec3
doc = ezdxf.new("R2000")
doc.header["$INSUNITS"] = 4
areas = {}
def piece(name, *draws):
    block = doc.blocks.new(name)
    block.add_text("Piece Name: " + name, dxfattribs={"layer": "1", "height": 5})
    points = []
    for draw in draws:
        entity = draw(block)
        entity.dxf.layer = "1"
        kind = entity.dxftype()
        if kind == "LINE": way = [entity.dxf.start, entity.dxf.end]
        elif kind == "LWPOLYLINE":
            way = []
            for part in entity.virtual_entities():
                some = [part.dxf.start, part.dxf.end] if part.dxftype() == "LINE" else list(part.flattening(0.0005))
                if way and (some[0] - way[-1]).magnitude > 1e-6: some.reverse()
                way += some
        else: way = list(entity.flattening(0.0005))
        points += [Vec3(p) for p in way]
    areas[name.lower()] = abs(sum(points[i - 1].x * points[i].y - points[i].x * points[i - 1].y for i in range(len(points)))) / 2e6
def line(a, b): return lambda block: block.add_line(a, b)
def spline(points, degree=3, knots=None, weights=None):
    def draw(block):
        if weights: return block.add_rational_spline(points, weights, degree=degree, knots=knots)
        entity = block.add_spline(degree=degree)
        entity.control_points = points
        entity.knots = knots or ezdxf.math.open_uniform_knot_vector(len(points), degree + 1)
        return entity
    return draw
top = line((300, 0), (0, 0))
piece("CUBIC", spline([(0, 0), (30, 200), (120, 420), (220, 250), (260, 330), (300, 0)]), top)
piece("KNOTTED", spline([(0, 0), (-60, 200), (120, 420), (220, 250), (300, 0)], 3, [0, 0, 0, 0, 0.2, 1, 1, 1, 1]), top)
piece("RATIONAL", spline([(0, 0), (0, 200), (150, 300), (300, 200), (300, 0)], 2, None, [1, 3, 0.5, 2, 1]), top)
piece("QUINTIC", spline([(0, 0), (0, 300), (100, 100), (200, 500), (300, 200), (320, 90), (300, 0)], 5), top)
piece("OVAL", lambda block: block.add_ellipse((0, 0), (120, 160), 0.6))
piece("HALF_OVAL", lambda block: block.add_ellipse((150, 0), (150, 0), 0.7, 0, math.pi), line((0, 0), (300, 0)))
piece("BEHIND", lambda block: block.add_arc((-150, 0), 150, 0, 180, dxfattribs={"extrusion": (0, 0, -1)}), line((0, 0), (300, 0)))
piece("BULGED", lambda block: block.add_lwpolyline([(0, 0, 0), (300, 0, 0.3), (300, 200, -0.2), (0, 250, 0.5)], format="xyb", close=True))
doc.saveas(sys.argv[1])
json.dump(areas, open(sys.argv[2], "w"))
PY
  run 0 import curved.dxf -o curved.garment
  for name in cubic knotted rational quintic oval half_oval behind bulged; do
    panel=$(grep -io "^panel $name" curved.garment | sed 's/^panel //')
    echo "measure ${name}_area = area($panel)" >>curved.garment
  done
  run 0 check curved.garment --json
  /usr/bin/python3 - curved.json out.txt <<'PY' || fail "ezdxf says other areas of curved pieces"
import json, sys
drawn, read = json.load(open(sys.argv[1])), {m["name"]: m["value"] for m in json.load(open(sys.argv[2]))["measures"]}
bad = [(name, area, read[name + "_area"]) for name, area in drawn.items() if abs(read[name + "_area"] / area - 1) > 1e-4]
print(bad) if bad else None
sys.exit(bool(bad) or len(drawn) != 8)
PY
else
  echo "skipped: areas of DXF pieces by ezdxf (python3-ezdxf is not installed)"
fi
# ---- drawings in SVG
run 0 export piece.garment -o piece.svg
run 0 import piece.svg -o drawn.garment
run 0 check drawn.garment
printf '<svg><path' >broken.svg
run 1 import broken.svg -o broken.garment
complains "error[G0970]"
absent broken.garment
# One to the other, and by `save`.
run 0 export piece.svg -o drawn.dxf
run 0 export piece.dxf -o drawn.json
run 0 import drawn.json -o drawn_again.garment
sed 's/^expect.*/save "cloth.dxf", "cloth.json"/' square.garment >saves.garment
run 0 run saves.garment --no-pictures -o saves_out
exists saves_out/cloth.dxf
exists saves_out/cloth.json
run 2 export square.garment -o square.pdf
complains "error[G0907]"
absent square.pdf
printf '{"pattern": [}' >broken.json
run 1 import broken.json -o broken.garment
complains "error[G0940]"
absent broken.garment

# ---- limits
run 0 limits
says "50,000,000"
says "G1601"
run 0 limits --json
is_json out.txt

# ---- what a `solve` found
cat >solved.garment <<'END'
use fabrics
solve wide in 5 cm .. 40 cm so wide * wide == 4 * wide * 5 cm
measure double_wide = 2 * wide
panel cloth of fabrics.satin {
  outline from (0, 0) {
    edge bottom to (wide, 0) free
    edge right_side to (wide, 10 cm) free
    edge top to (0, 10 cm) free
    close left_side free
  }
}
place cloth flat at (0, 1 m, 0)
END
run 0 check solved.garment --json
is_json out.txt
says '"residual"'
says '"shown": "20 cm"'
says '"shown": "40 cm"'

# ---- scripts read below their folder and write below the output folder, whatever they try
mkdir -p jail/inner secret granted
printf 'let hidden = 1\n' >secret/library.garment
printf 'let open_to_all = 1\n' >jail/inner/library.garment
ln -s ../secret/library.garment jail/link.garment
ln -s ../secret jail/folder
mkfifo jail/pipe.garment
for name in '../secret/library.garment' "$work/secret/library.garment" link.garment folder/library.garment \
  /etc/passwd /proc/self/environ inner/../../secret/library.garment; do
  printf 'use "%s" as other\n' "$name" >jail/try.garment
  run 1 check jail/try.garment
  complains "error[G0328]"
  ok
  grep -q hidden err.txt && fail "the message shows what the file holds"
done
printf 'use "pipe.garment" as other\n' >jail/try.garment
run 1 check jail/try.garment
complains "is not a regular file"
printf 'use "inner/library.garment" as other\nlet a = other.open_to_all\n' >jail/try.garment
run 1 check jail/try.garment # no panels
complains "G0452"
printf 'use "link.garment" as other\nlet a = other.hidden\n' >jail/try.garment
run 1 check jail/try.garment --allow-read secret
complains "G0452"
ok
grep -q G0328 err.txt && fail "--allow-read grants nothing"
for name in '../secret/form.obj' /proc/self/environ /dev/zero; do
  sed "s|^drape.*|body other = mesh(\"$name\")|; /^expect/d" square.garment >jail/try.garment
  run 1 check jail/try.garment
  complains "error[G0328]"
done
ln -s /proc/self/environ jail/form.obj
sed 's|^drape.*|body other = mesh("form.obj")|; /^expect/d' square.garment >jail/try.garment
run 1 check jail/try.garment
complains "error[G0701]"
complains "--allow-read"

sed 's/^expect.*/save "..\/secret\/out.obj"/' square.garment >jail/try.garment
run 1 run jail/try.garment --no-pictures -o written
complains "error[G0328]"
absent secret/out.obj
mkdir -p written
ln -s ../secret written/aside
ln -s ../secret/linked.obj written/linked.obj
printf 'kept\n' >secret/linked.obj
sed 's/^expect.*/save "aside\/out.obj"/' square.garment >jail/try.garment
run 3 run jail/try.garment --no-pictures -o written
complains "error[G0902]"
absent secret/out.obj
sed 's/^expect.*/save "linked.obj", "made\/deeper.obj"/' square.garment >jail/try.garment
run 0 run jail/try.garment --no-pictures -o written
exists written/made/deeper.obj
no_leftovers written
ok
[ "$(cat secret/linked.obj)" = kept ] || fail "a link in the output folder was followed"
sed "s|^expect.*|save \"$work/granted/out.obj\"|" square.garment >jail/try.garment
run 1 run jail/try.garment --no-pictures -o written
run 0 run jail/try.garment --no-pictures -o written --allow-write granted
exists granted/out.obj

# ---- control characters of a script do not reach the terminal
printf 'assert false "\033[2Jgone\007"\n' >escapes.garment
run 1 check escapes.garment
ok
grep -q "$(printf '\033')" err.txt && fail "an escape of the script reaches the terminal"

# ---- scripts that would take all time or memory
printf 'panel sail of fabrics.satin {\n  outline circle((0, 0), 99 m) free\n  resolution 1 mm\n}\nuse fabrics\nplace sail flat at (0, 1 m, 0)\n' >sail.garment
run 1 model sail.garment
complains "error[G0452]"
head -c 5000000 /dev/zero | tr '\0' '#' >large.garment
run 3 check large.garment
complains "error[G0901]"
head -c 200000001 /dev/zero | tr '\0' '#' >huge.obj
sed 's|^drape.*|body other = mesh("huge.obj")|; /^expect/d' square.garment >huge.garment
run 1 check huge.garment
complains "error[G0701]"
rm huge.obj

# ---- test
mkdir -p goldens/check nothing
printf '#! ok\nlet w = 3 cm\n' >goldens/check/fine.garment
run 1 test goldens # no panels: one more diagnostic than was expected
says "G0452"
says "0 passed, 1 failed"
printf 'let w = 3 cm\n#! error[G0305] 9-18 "between a length"\nlet v = 20 cm + 3\n' >goldens/check/fine.garment
run 1 test goldens
says "missing: line 3 error[G0305] 9-18"
sed -i 's/9-18/9-17/' goldens/check/fine.garment
run 0 test goldens
says "1 passed, 0 failed"
sed -i 's/error\[/warning[/' goldens/check/fine.garment
run 1 test goldens
mkdir -p goldens/parse
printf 'let w = 3 cm\n' >goldens/parse/tree.garment
rm goldens/check/fine.garment
run 1 test goldens
says "--update writes one"
run 0 test goldens --update
exists goldens/parse/tree.expected
run 0 test goldens
rm goldens/parse/tree.garment
printf 'let w = 3 cm\n' >goldens/parse/other.garment
run 1 test goldens
says "has no script"
run 3 test nothing
complains "error[G0904]"
run 3 test nowhere
complains "error[G0904]"


# A failing case of each kind is told as failing.
mkdir -p mine/run mine/format mine/model
{ printf '#! expect: 3 cm\nlet w = 2 cm\n'; cat square.garment; } >mine/value.garment
run 1 test mine
says "expected 3 cm, found 2 cm"
printf '#! stage: parse\n#! oops\nlet w = 2 cm\n' >mine/value.garment
run 1 test mine
says 'line 2: `#! oops` says nothing known'
cat >mine/value.garment <<'EOF'
use fabrics
#! stage: check
#! tolerance: 1 mm
#! expect: 25 cm
let w = 50.1 cm / 2
#! expect: 25 cm
param v = 25 cm
panel towel of fabrics.linen {
  outline from (0, 0) {
    edge bottom to (w, 0) free
    edge right_side to (w, 40 cm) free
    edge top to (0, 40 cm) free
    close left_side free
  }
}
pin peg on towel at towel.top.start
EOF
run 0 test mine
sed -i 's/^#! tolerance.*/#! tolerance: 0.1%/' mine/value.garment
run 1 test mine
says "expected 25 cm, found 25.05 cm"
sed -i 's/^#! tolerance.*/#! tolerance: 1 furlong/' mine/value.garment
run 1 test mine
says "says nothing known"
rm mine/value.garment
printf 'let   w=3 cm\n' >mine/format/loose.garment
printf 'let w = 3  cm\n' >mine/format/loose.expected
run 1 test mine
says "- let w = 3  cm"
says "+ let w = 3 cm"
run 0 test mine --update
says "1 updated"
run 0 test mine/format
cp square.garment mine/model/square.garment
run 0 test mine --update
sed -i '1s/\([0-9][0-9]*\)/1\1/' mine/model/square.expected
run 1 test mine --filter '*model*square*'
says "  ~ "
says "0 passed, 1 failed"
sed -i '1i #! tolerance: 2000%' mine/model/square.expected
run 0 test mine/model
run 0 test mine/model --update
ok
head -1 mine/model/square.expected | grep -q tolerance || fail "--update dropped the tolerance of a golden"
# Scripts with a `drape` are draped, and their `expect`s judged.
cp square.garment mine/draped.garment
run 0 test mine --filter draped
complains "draping took"
sed -i 's/^expect.*/expect strain(cloth) > 90%/' mine/draped.garment
run 1 test mine --filter draped
says "does not hold"
run 0 test mine --filter draped --no-drape
# What `check` refuses is no passed script, draped or not; libraries are looked for where --library says.
mkdir trimmed && cp trimmed.garment trimmed/trimmed.garment
run 1 test trimmed
run 1 test trimmed --no-drape
says "error[G0318]"
run 0 test trimmed --no-drape --library trims --library more_trims
run 0 test trimmed --library trims --library more_trims
run 0 test mine --list
says "run    mine/draped.garment"
says "format mine/format/loose.garment"
run 1 test mine --junit out.xml -j 2
says "2 passed, 1 failed"
ok
grep -q '<testsuites name="garment test" tests="3" failures="1" errors="0">' out.xml || fail "out.xml does not count"
ok
grep -q '&gt; 90%' out.xml || fail "out.xml is not escaped"
# The report is what build servers read, whatever bytes the scripts and their names hold.
mkdir -p 'mine/check/a "b" <c>'
printf 'garment 1 "caf\xe9"\n' >'mine/check/a "b" <c>/latin & one.garment'
printf '#! ok\nlet w = "\xef\xbf\xbe \x01"\n' >mine/check/controls.garment
run 1 test mine --junit out.xml
if command -v python3 >/dev/null; then
  ok
  python3 "$here/junit_rules.py" out.xml >rules.txt 2>&1 || fail "out.xml breaks the rules of JUnit reports: $(cat rules.txt)"
  run 0 test "$here/../golden/check/lexis" --junit out.xml
  ok
  python3 "$here/junit_rules.py" out.xml >rules.txt 2>&1 || fail "out.xml breaks the rules of JUnit reports: $(cat rules.txt)"
else
  echo "SKIPPED: python3 is not here; JUnit reports were not held against their rules"
fi
rm -r mine/check
run 3 test mine --junit plain_file/out.xml
complains "error[G0902]"
run 3 test mine --filter nothing_like_it
complains "--list shows them all"

echo "$checks checks, $failures failures"
[ $failures -eq 0 ]
