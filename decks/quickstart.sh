#!/usr/bin/env bash
# From a fresh clone to the pictures of an impact: install, build, run and report.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=decks/setup.sh
source decks/setup.sh

recipe=decks/small_coupon/quickstart.toml
results=results/small_coupon
job=quickstart

install_system_packages build python
make_venv build
build release plydyn || give_up "the solver could not be built"

mkdir -p "$results"
say "making $results/$job.k from $recipe"
.venv/bin/plydyn-pre deck "$recipe" -o "$results/$job.k"
threads=$(nproc)
say "running it"
build/release/plydyn run "$results/$job.k" -j "$job" -o "$results" ncpu=$((threads < 4 ? threads : 4))
say "drawing the report"
.venv/bin/plydyn-post report "$results/$job.vtkhdf"

say "done"
printf '\n'
printf '%s\n' \
  "recipe    $recipe" \
  "deck      $results/$job.k" \
  "listing   $results/$job.out" \
  "histories $results/$job.*.csv" \
  "fields    $results/$job.vtkhdf (opens in ParaView)" \
  "report    $(find "$results" -name report.html | paste -sd' ') (opens in a browser; pictures beside it)"
