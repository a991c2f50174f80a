#!/usr/bin/env bash
# Prompt sessions as text: every transcript in tests/golden/repl is what the program must say to the entries in it.
#   repl_sessions.sh PROGRAM SOURCE_DIR [--update]
# A transcript holds the entries as they are echoed (`> entry`, further lines `. more`) and the answers. Its first line may
# be `# FILE`: the script that is opened, from examples/ or tests/golden/repl/scripts/. Its last line is `# exit CODE`.
set -u
program=$1
source=$2
update=${3:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
checks=0
for transcript in "$source"/tests/golden/repl/*.transcript; do
  rm -rf "$work"/* && cd "$work" || exit 1
  cp "$source"/examples/*.garment "$source"/tests/golden/repl/scripts/* . 2>/dev/null
  file=$(sed -n '1s/^# //p' "$transcript")
  sed -n 's/^[>.] //p' "$transcript" >"$work/entries"
  {
    [ -n "$file" ] && echo "# $file"
    "$program" repl --plain $file <"$work/entries" 2>&1
    echo "# exit $?"
  } >"$work/said"
  checks=$((checks + 1))
  if ! diff -u "$transcript" "$work/said" >"$work/difference"; then
    if [ "$update" = --update ]; then
      cat "$work/difference"
      cp "$work/said" "$transcript"
    else
      failures=$((failures + 1))
      echo "FAILED: $(basename "$transcript")"
      head -60 "$work/difference"
    fi
  fi
done
echo "prompt sessions: $checks, $failures failed"
[ $checks -gt 0 ] && [ $failures -eq 0 ]
