#!/bin/sh
# run.sh PROGRAM SOURCE_DIR: the scripted client of the language server; 77 where Python is not there.
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
exec python3 "$(dirname "$0")/run_lsp.py" "$@"
