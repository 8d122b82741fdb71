#!/usr/bin/env bash
# run.sh PART...: run some parts of the tests by hand, output on the screen.
# Parts: lint shell structure site unit output deck debug_deck parallel faults hpc preprocessor postprocessor
# studies verification, and solver: output deck parallel faults hpc verification in one
# tests/check.sh sets everything up and runs them all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

python=.venv/bin/python
workers=$(nproc)
# one thread of linear algebra for each worker; threads and ranks that wait leave their core to others,
# for there are more of them than cores
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
export OMP_WAIT_POLICY=passive OMPI_MCA_mpi_yield_when_idle=1

# half of the tests in their order for each worker, so that few fixtures are made twice; who has
# ended takes from others
pytest_of() {
  "$python" -m pytest -q -p no:cacheprovider --numprocesses "$workers" --dist worksteal "$@"
}

run_lint() {
  .venv/bin/ruff check decks manual preprocessor postprocessor tests
  .venv/bin/ruff format --check decks manual preprocessor postprocessor tests
  [[ -x .venv/bin/mypy ]] || { echo "no mypy: .venv/bin/pip install -r tests/requirements.txt" >&2; return 1; }
  # .mypy.ini names what is held
  .venv/bin/mypy
  git ls-files -z '*.md' decks src '*processor/src' |
    xargs -0 .venv/bin/codespell --ignore-words manual/site/words.txt --skip '*.json,*.png'
  "$python" manual/site/links.py
  if git grep -nE '^(<<<<<<<|>>>>>>>) '; then
    echo "a merge was left half done" >&2
    return 1
  fi
  # the plate kernels are expanded from their templates when a build is configured: not that of the
  # program, which may be under way
  cmake --preset release -B build/lint >/dev/null
  .venv/bin/fortitude check src tests/unit tests/output build/lint/src/element
}

run_shell() {
  git ls-files -z '*.sh' '*.slurm' .ci/run decks/hpc/plydyn-batch decks/hpc/plydyn-chain | xargs -0 shellcheck
}

run_structure() {
  pytest_of tests/structure tests/mutants tests/bench
}

run_site() {
  "$python" manual/site/build.py
}

run_unit() {
  ctest --test-dir build/debug --label-regex unit --output-on-failure --no-tests=error --parallel "$workers"
}

run_output() {
  WRITE_SAMPLE=$PWD/build/release/tests/output/write_sample pytest_of tests/output
}

# what finds nothing, or takes long to compile, without the checks of the run-time library
checked_only=(--ignore-glob='*/test_fuzz*.py' --ignore-glob='*/test_field_example.py')

run_deck() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/deck tests/compare "${checked_only[@]}"
}

# with the checks of the run-time library: every reader, element, law, joint, load and body once,
# restarts, stages, and mutants of decks
run_debug_deck() {
  PLYDYN=$PWD/build/debug/plydyn pytest_of \
    tests/deck/test_{decks,field_example,fuzz,fuzz_stages,keyword_examples,mass_scaling,quasi_static}.py \
    tests/deck/test_{restart,stages}.py
}

run_parallel() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/parallel
}

run_faults() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/faults
}

run_hpc() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/hpc
}

# in one session: modules are loaded once, and no worker waits at the end of a part
run_solver() {
  PLYDYN=$PWD/build/release/plydyn WRITE_SAMPLE=$PWD/build/release/tests/output/write_sample pytest_of \
    tests/verification tests/deck tests/parallel tests/faults tests/hpc tests/compare tests/output \
    "${checked_only[@]}"
}

run_preprocessor() {
  PLYDYN=$PWD/build/release/plydyn pytest_of preprocessor
}

run_postprocessor() {
  PLYDYN=$PWD/build/release/plydyn pytest_of postprocessor
}

run_studies() {
  PLYDYN=$PWD/build/release/plydyn pytest_of decks/studies
}

run_verification() {
  PLYDYN=$PWD/build/release/plydyn pytest_of tests/verification
}

for part in "$@"; do
  declare -F "run_$part" >/dev/null || { sed -n 2,5p "$0" >&2; exit 1; }
  "run_$part"
done
