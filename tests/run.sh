#!/usr/bin/env bash
# run.sh PART...: run some parts of the tests by hand, output on the screen.
# Parts: lint shell unit deck debug_deck preprocessor postprocessor verification
# tests/check.sh sets everything up and runs them all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

python=.venv/bin/python
workers=$(nproc)

pytest_of() {
  "$python" -m pytest -q -p no:cacheprovider --numprocesses "$workers" "$@"
}

run_lint() {
  .venv/bin/ruff check preprocessor postprocessor tests
  .venv/bin/ruff format --check preprocessor postprocessor tests
  .venv/bin/fortitude check src tests/unit
}

run_shell() {
  shellcheck .ci/run decks/*.sh tests/*.sh
}

run_unit() {
  ctest --test-dir build/debug --output-on-failure --no-tests=error --parallel "$workers"
}

run_deck() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/deck
}

run_debug_deck() {
  PLYDYN=$PWD/build/debug/plydyn pytest_of tests/deck
}

run_preprocessor() {
  PLYDYN=$PWD/build/release/plydyn pytest_of preprocessor
}

run_postprocessor() {
  PLYDYN=$PWD/build/release/plydyn pytest_of postprocessor
}

run_verification() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/verification
}

for part in "$@"; do
  declare -F "run_$part" >/dev/null || { sed -n 2,4p "$0" >&2; exit 1; }
  "run_$part"
done
