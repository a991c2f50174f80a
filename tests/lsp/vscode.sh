#!/bin/sh
# vscode.sh PROGRAM SOURCE_DIR: the grammar of colours is the one that the tables give, colours every token of the examples and
# the library as the syntax tree has it, and the client's types fit; 77 where the packages of npm are not there.
set -e
program=$1
cd "$2/editors/vscode"
"$program" reference --textmate | cmp - syntaxes/garment.tmLanguage.json || {
  echo "make it anew: garment reference --textmate > editors/vscode/syntaxes/garment.tmLanguage.json"
  exit 1
}
command -v node >/dev/null || { echo "skipped: no node"; exit 77; }
[ -d node_modules ] || { echo "skipped: run \`npm ci\` in editors/vscode first"; exit 77; }
node test/colours.mjs "$program"
npm run --silent check
npm run --silent build -- --log-level=warning
