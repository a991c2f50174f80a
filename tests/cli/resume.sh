#!/usr/bin/env bash
# Kills runs at arbitrary instants and lets them go on: they end in what a run that nobody killed ends in.
#   resume.sh PROGRAM SOURCE_DIR [SCRIPT...]
set -u
program=$1
source=$2
here=$2/tests/cli/resume
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

failures=0 checks=0 kills=0 gone_on=0
fail() { failures=$((failures + 1)); echo "FAILED: $*"; sed 's/^/    /' log.txt 2>/dev/null | tail -20; }
ok() { checks=$((checks + 1)); }
RANDOM=17  # the same instants of every run, as far as the machine has the same speed

# same A B: the files of two results are alike, but for the times in report.json
same() {
  local file
  for file in $(cd "$1" && find . -type f | sort); do
    ok
    if [ "$(basename "$file")" = report.json ]; then
      cmp -s <(sed '/"timings"/,$d' "$1/$file") <(sed '/"timings"/,$d' "$2/$file") || fail "$file is not the same"
    else
      cmp -s "$1/$file" "$2/$file" || fail "$file is not the same"
    fi
  done
  ok
  [ "$(cd "$1" && find . -type f | sort)" = "$(cd "$2" && find . -type f | sort)" ] || fail "other files: $(diff <(cd "$1" && find . -type f | sort) <(cd "$2" && find . -type f | sort))"
}

# killed NAME TIMES ARGUMENT...: runs it, kills it TIMES times after a random part of its time, and lets it end
killed() {
  local name=$1 times=$2 begun code share k
  shift 2
  begun=$(date +%s%N)
  "$program" run "$@" --no-pictures --no-checkpoint -o "whole/$name" >log.txt 2>&1
  local expected=$? taken=$((($(date +%s%N) - begun) / 1000000))
  for ((k = 0; k < times; k++)); do
    "$program" run "$@" --no-pictures --checkpoint-steps 4 --resume -o "cut/$name" >log.txt 2>&1 &
    local pid=$!
    share=$((taken * (RANDOM % 90 + 10) / 100 / (times / 2 + 1)))
    sleep "$((share / 1000)).$(printf '%03d' $((share % 1000)))"
    kill -9 $pid 2>/dev/null && kills=$((kills + 1))
    wait $pid 2>/dev/null
    grep -q "going on from a checkpoint" log.txt && gone_on=$((gone_on + 1))
  done
  "$program" run "$@" --no-pictures --checkpoint-steps 4 --resume -o "cut/$name" >log.txt 2>&1
  code=$?
  grep -q "going on from a checkpoint" log.txt && gone_on=$((gone_on + 1))
  ok
  [ $code -eq $expected ] || fail "$name returned $code after it was cut off, $expected when it was not"
  same "whole/$name" "cut/$name"
}

if [ $# -gt 0 ]; then
  for script in "$@"; do killed "$(basename "$script" .garment)" 5 "$script"; done
else
  killed all_acts 8 "$here/all_acts.garment"
  killed study 6 "$here/study.garment"
  killed pulled 6 "$here/pulled.garment"
fi

# ---- Ctrl-C leaves a checkpoint; damaged slots are left out; other scripts and parameters are refused
script=$here/all_acts.garment
"$program" run "$script" --no-pictures --checkpoint-steps 3 --max-steps 20 -o limited >log.txt 2>&1
ok
[ -z "$(find limited -name 'checkpoint-*')" ] || fail "a run that has ended leaves checkpoints"
cut_off() {  # a run killed when it has written both slots
  rm -rf slots
  "$program" run "$script" --no-pictures --checkpoint-steps 3 -o slots >log.txt 2>&1 &
  local pid=$!
  for ((k = 0; k < 300; k++)); do
    [ -s slots/checkpoint-1.state ] && [ -s slots/checkpoint-2.state ] && break
    sleep 0.02
  done
  kill "-$1" $pid 2>/dev/null
  wait $pid 2>/dev/null
  stopped=$?
}
goes_on() { "$program" run "$script" --no-pictures --resume -o slots "$@" >log.txt 2>&1; code=$?; }
ends_alike() { [ -d whole/all_acts ] && same whole/all_acts slots; }

cut_off INT
ok
[ $stopped -eq 130 ] || fail "Ctrl-C returned $stopped"
ok
grep -q -- "--resume goes on" log.txt || fail "Ctrl-C does not say how to go on"
goes_on -p long=15cm
ok
[ $code -eq 3 ] && grep -q "G0911" log.txt && grep -q 'parameter `long` (`15 cm`, then `14 cm`)' log.txt || fail "another parameter was not refused"
goes_on --no-self-collision
ok
[ $code -eq 3 ] && grep -q "G0911.*no-self-collision" log.txt || fail "another option was not refused"
cp -r slots changed_slots
sed 's/0.1 s/0.12 s/' "$script" >all_acts.garment
"$program" run all_acts.garment --no-pictures --resume -o slots >log.txt 2>&1
code=$?
ok
[ $code -eq 3 ] && grep -q "G0911.*the script" log.txt || fail "another script was not refused"
goes_on
ok
[ $code -eq 0 ] && grep -q "going on from a checkpoint" log.txt || fail "a run does not go on after Ctrl-C"
ends_alike

for damage in cut flip empty garbage; do
  rm -rf slots && cp -r changed_slots slots
  newest=$(ls -t slots/checkpoint-* | head -1)
  case $damage in
    cut) truncate -s -7 "$newest" ;;
    flip) printf '\377' | dd of="$newest" bs=1 seek=$((RANDOM % $(stat -c %s "$newest"))) conv=notrunc 2>/dev/null ;;
    empty) : >"$newest" ;;
    garbage) head -c 5000 /dev/urandom >"$newest" ;;
  esac
  goes_on
  ok
  [ $code -eq 0 ] && grep -q "warning\[G0910\]" log.txt && grep -q "going on from a checkpoint" log.txt || fail "$damage: the other slot was not taken"
  ends_alike
done
rm -rf slots && cp -r changed_slots slots
for slot in slots/checkpoint-*; do head -c 100 "$slot" >half && cp half "$slot"; done
goes_on
ok
[ $code -eq 0 ] && [ "$(grep -c "G0910" log.txt)" -eq 2 ] && grep -q "no checkpoint to go on from" log.txt || fail "without a sound slot it does not begin at the start"
ends_alike

# ---- a checkpoint that cannot be written is told once, and the drape goes on
mkdir -p blocked/checkpoint-1.state
"$program" run "$script" --no-pictures --checkpoint-steps 3 -o blocked >log.txt 2>&1
code=$?
ok
[ $code -eq 0 ] && [ "$(grep -c "G0912" log.txt)" -eq 1 ] || fail "that no checkpoint can be written is not told once"

echo "$checks checks, $kills kills, $gone_on times it went on from a checkpoint, $failures failures"
ok
[ $gone_on -gt 0 ] || fail "it never went on from a checkpoint"
[ $failures -eq 0 ]
