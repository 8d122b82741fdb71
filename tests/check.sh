#!/usr/bin/env bash
# Everything that must hold before a change lands: build with all run-time checks, build optimised,
# run every test and every linter. Logs are in build/logs; the last line counts the parts.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
# shellcheck source=decks/setup.sh
source decks/setup.sh

passed=0
skipped=0
failed=()

# part NAME COMMAND...: run it, tell how it went in one line
part() {
  local name=$1 log=$logs/$1.log start=$SECONDS
  shift
  say "$name"
  mkdir -p "$logs"
  if "$@" >"$log" 2>&1 </dev/null; then
    passed=$((passed + 1))
    printf '        ok, %d s  %s\n' $((SECONDS - start)) "$(closing_line "$log")"
  else
    failed+=("$name")
    tail -n 40 "$log" | sed 's/^/        | /'
    printf '        FAILED, %d s; all of it: %s\n' $((SECONDS - start)) "$log"
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

# tests_of PRESET PART: run a part of the tests when there is a program to test
tests_of() {
  if [[ " ${failed[*]} " == *" build_$1 "* ]]; then
    skipped=$((skipped + 1))
    say "$2: not run, build_$1 failed"
  else
    part "$2" bash tests/run.sh "$2"
  fi
}

install_system_packages build python test
make_venv build test

part shell bash tests/run.sh shell
part lint bash tests/run.sh lint
part structure bash tests/run.sh structure
part site bash tests/run.sh site
part build_debug build_strictly debug
part build_release build_strictly release
tests_of debug unit
tests_of release output
tests_of release preprocessor
tests_of release deck
tests_of debug debug_deck
tests_of release parallel
tests_of release faults
tests_of release hpc
tests_of release postprocessor
tests_of release studies
tests_of release verification

say "end"
if [[ ${#failed[@]} -gt 0 ]]; then
  printf 'failed: %s\n' "${failed[*]}"
fi
printf 'check: %d passed, %d failed, %d skipped\n' "$passed" "${#failed[@]}" "$skipped"
[[ ${#failed[@]} -eq 0 ]]
