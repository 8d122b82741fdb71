#!/usr/bin/env bash
# run.sh PLYDYN: every deck of this folder is broken; plydyn must leave with exit code 2 and say each
# line of the deck's .expected file.
set -uo pipefail

plydyn=$(realpath "${1:?usage: run.sh PLYDYN}")
cd "$(dirname "${BASH_SOURCE[0]}")" || exit 1

passed=0
failed=0
for deck in *.k; do
  said=$("$plydyn" check "$deck" 2>&1)
  code=$?
  wrong=""
  [[ $code -eq 2 ]] || wrong="leaves with exit code $code, must be 2"
  while IFS= read -r fragment; do
    [[ $said == *"$fragment"* ]] || wrong+=$'\n'"  does not say: $fragment"
  done <"${deck%.k}.expected"
  if [[ -z $wrong ]]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf 'FAILED %s: %s\n%s\n' "$deck" "$wrong" "$said"
  fi
done
printf '%d passed, %d failed\n' "$passed" "$failed"
[[ $failed -eq 0 ]]
