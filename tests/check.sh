#!/usr/bin/env bash
# Everything that must hold before a change lands: build with all run-time checks, build optimised,
# run every test and every linter. Logs are in build/logs; the last line counts the parts.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=decks/setup.sh
source decks/setup.sh

if (($# > 0)); then
  echo "check.sh runs everything and takes no argument; tests/run.sh PART runs a part" >&2
  exit 2
fi

# what Python compiles is kept, and not compiled again by each interpreter that is started
unset PYTHONDONTWRITEBYTECODE

verdicts=$logs/verdicts
mkdir -p "$logs"
: >"$verdicts"

# part NAME COMMAND...: run it, tell how it went in one line
part() {
  local name=$1 log=$logs/$1.log start=$SECONDS
  shift
  say "$name"
  if "$@" >"$log" 2>&1 </dev/null; then
    say "$name: ok, $((SECONDS - start)) s  $(closing_line "$log")"
    printf 'passed %s\n' "$name" >>"$verdicts"
  else
    tail -n 40 "$log" | sed 's/^/        | /'
    say "$name: FAILED, $((SECONDS - start)) s; all of it: $log"
    printf 'failed %s\n' "$name" >>"$verdicts"
  fi
}

# The line of a log in which a test runner counts
closing_line() {
  grep -E '[0-9]+ (passed|failed)|tests passed' "$1" | tail -n 1
}

# build_strictly PRESET: build, with every warning an error
build_strictly() {
  build "$1" all -DCMAKE_COMPILE_WARNING_AS_ERROR=ON || return 1
  if grep -i 'warning:' "$logs/configure-$1.log" "$logs/build-$1.log"; then
    return 1
  fi
}

build_both() {
  part build_debug build_strictly debug
  part build_release build_strictly release
}

# What needs no program but Python
check_sources() {
  (make_venv build test) || return 1
  part lint bash tests/run.sh lint
  part site bash tests/run.sh site
  part structure bash tests/run.sh structure
  part shell bash tests/run.sh shell
}

# tests_of PRESET PART: run a part of the tests when there is a program to test
tests_of() {
  if grep -qx "failed build_$1" "$verdicts"; then
    say "$2: not run, build_$1 failed"
    printf 'skipped %s\n' "$2" >>"$verdicts"
  else
    part "$2" bash tests/run.sh "$2"
  fi
}

# How many parts have a verdict
count() {
  grep -c "^$1 " "$verdicts"
}

install_system_packages build python test

# side by side: to download packages, or to look at the sources, keeps one core busy at most
build_both &
check_sources
has_python=$?
wait
((has_python == 0)) || exit 1

tests_of debug unit
tests_of release solver
tests_of release preprocessor
tests_of release postprocessor
tests_of release studies
tests_of debug debug_deck

say "end"
if grep -q '^failed ' "$verdicts"; then
  printf 'failed: %s\n' "$(sed -n 's/^failed //p' "$verdicts" | paste -sd ' ')"
fi
printf 'check: %d passed, %d failed, %d skipped\n' "$(count passed)" "$(count failed)" "$(count skipped)"
[[ $(count failed) -eq 0 ]]
