#!/usr/bin/env bash
# The prompt through a terminal, as a person uses it: keys, history, completion, Ctrl-C, undo, save.
#   repl_tmux.sh PROGRAM SOURCE_DIR
set -u
program=$1
source=$2
if ! command -v tmux >/dev/null; then
  echo "SKIPPED: tmux is not here; the prompt was not tried on a terminal"
  exit 0
fi
work=$(mktemp -d)
socket="garment-$$-0"
trap 'tmux -L "$socket" kill-server 2>/dev/null; sleep 0.5; rm -rf "$work"' EXIT
cp "$source/examples/skirt.garment" "$source/tests/cli/slow.garment" "$work"
failures=0
checks=0
began=0

screen() { tmux -L "$socket" capture-pane -p -J -S -500 -t garment 2>&1 | sed 's, *$,,'; }
fail() {
  failures=$((failures + 1))
  echo "FAILED: $*"
  screen | grep -v '^$' | tail -25 | sed 's/^/    /'
}
# waits SECONDS TEXT: until the screen says it
waits() {
  local until=$((SECONDS + $1))
  checks=$((checks + 1))
  while ! screen | grep -qF -- "$2"; do
    if [ $SECONDS -ge $until ]; then
      fail "the screen does not say: $2"
      return 1
    fi
    sleep 0.1
  done
}
# ready SECONDS: until the last line is an empty prompt
ready() {
  local until=$((SECONDS + $1))
  while [ "$(screen | grep -v '^$' | tail -1)" != ">" ]; do
    if [ $SECONDS -ge $until ]; then
      fail "no prompt after $1 s"
      return 1
    fi
    sleep 0.1
  done
}
keys() { tmux -L "$socket" send-keys -t garment "$@"; }
type_in() { keys -l -- "$1" && keys Enter; }
clear_screen() {
  keys C-l
  sleep 0.2
  tmux -L "$socket" clear-history -t garment
}
begin() {
  tmux -L "$socket" kill-server 2>/dev/null
  socket="garment-$$-$((++began))"  # the old server may still be on its way out
  tmux -L "$socket" -f /dev/null new-session -d -s garment -x 120 -y 50 -c "$work" \
    "env XDG_STATE_HOME='$work/state' '$program' repl $1; echo left with \$?; sleep 600"
}
state() { screen | sed -n 's/^state \([0-9a-f]\{16\}\) .*/\1/p' | tail -1; }

# ---- edits, undo, save
begin skirt.garment
waits 60 "particles"
ready 10
type_in ":where"
waits 10 "state "
ready 10
start=$(state)
type_in "long = 62 cm"
waits 20 "long: 58 cm -> 62 cm"
ready 10
clear_screen
type_in ":where"
waits 10 "state "
edited=$(state)
checks=$((checks + 1))
[ -n "$start" ] && [ "$start" != "$edited" ] || fail "the edit did not change the state"
type_in ":undo"
waits 10 "undone: long = 62 cm"
ready 10
clear_screen
type_in ":where"
waits 10 "state "
checks=$((checks + 1))
[ "$(state)" = "$start" ] || fail ":undo did not give the state $start back, but $(state)"

# ---- history: up twice is the undo, Ctrl-R finds the edit
ready 10
keys C-r
keys -l "long ="
sleep 0.5
keys Enter
waits 20 "long: 58 cm -> 62 cm"
ready 10

# ---- completion
clear_screen
keys -l "front.wai"
keys Tab
waits 10 "front.waist"
keys -l "t"
keys C-u
keys -l ":mod"
keys Tab
sleep 0.3
keys Enter
waits 10 "hash"
ready 10

# ---- more lines by the parser's verdict; Ctrl-C forgets them
clear_screen
type_in "let q = (1 cm +"
waits 10 "."
keys C-c
waits 10 "^C"
type_in "let q = (1 cm +"
type_in "2 cm)"
waits 10 "added let q"
ready 10

# ---- save: the edits and nothing else
type_in ":undo"
waits 10 "undone: let q"
ready 10
type_in ":save"
waits 10 "wrote skirt.garment"
checks=$((checks + 1))
[ "$(diff "$source/examples/skirt.garment" "$work/skirt.garment" | grep -c '^[<>]')" = 2 ] || fail ":save changed more than the value"
checks=$((checks + 1))
grep -q '^param long = 62 cm in 30 cm .. 110 cm  "waist to hem"$' "$work/skirt.garment" || fail ":save did not write the value"

# ---- Ctrl-D asks once where edits would be lost
ready 10
type_in "long = 63 cm"
waits 20 "-> 63 cm"
ready 10
keys C-d
waits 10 "not saved"
keys C-d
waits 10 "left with 0"

# ---- the history is kept for the next time
begin skirt.garment
waits 60 "particles"
ready 10
keys Up
waits 10 "> long = 63 cm"
keys C-u
type_in ":quit"
waits 10 "left with 0"

# ---- Ctrl-C stops a drape at a state that is kept
begin slow.garment
waits 60 "particles"
ready 10
type_in "drape until rest settle exact"
waits 60 "Ctrl-C stops"
keys C-c
waits 60 "the shape is kept"
ready 10
clear_screen
type_in ":where"
waits 10 "interrupted after"
ready 10
clear_screen
type_in "cloth.top"
waits 10 "in the drape"
type_in ":quit"
waits 10 "left with 0"

echo "prompt on a terminal: $checks checks, $failures failed"
[ $failures -eq 0 ]
