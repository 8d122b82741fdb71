# shellcheck shell=bash
# Steps shared by decks/quickstart.sh and tests/check.sh; sourced from the top of the repository.
# Every step looks first and does nothing when there is nothing to do.

logs=build/logs

# A short line with the time since the script started
say() {
  printf '[%4ds] %s\n' "$SECONDS" "$*"
}

# Say what is wrong and end
give_up() {
  printf '\nerror: %s\n' "$*" >&2
  exit 1
}

# quietly LOG COMMAND...: output goes to the log; its end is shown when the command fails
quietly() {
  local log=$logs/$1.log
  shift
  mkdir -p "$logs"
  if ! "$@" >"$log" 2>&1 </dev/null; then
    tail -n 30 "$log" >&2
    printf '\nfailed: %s\nall of it: %s\n' "$*" "$log" >&2
    return 1
  fi
}

# Names of the system packages for the given uses, such as: build test
system_packages() {
  local use
  for use in "$@"; do
    sed -n "s/^$use //p" decks/system-packages.txt
  done | tr ' ' '\n'
}

# Which of those are not installed
missing_packages() {
  local package
  for package in $(system_packages "$@"); do
    dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      printf '%s\n' "$package"
  done
}

# install_system_packages USE...: with apt, as root or through sudo
install_system_packages() {
  local missing root=()
  if ! command -v dpkg-query >/dev/null; then
    say "not a Debian system: the packages of decks/system-packages.txt are taken as installed"
    return
  fi
  missing=$(missing_packages "$@" | tr '\n' ' ')
  if [[ -z $missing ]]; then
    return
  fi
  if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null ||
      give_up "as root, run: apt-get update && apt-get install --no-install-recommends $missing"
    root=(sudo)
  fi
  say "installing system packages: $missing"
  quietly apt-update "${root[@]}" apt-get update ||
    say "the package lists could not be refreshed; trying with the old ones"
  # shellcheck disable=SC2086  # one word per package
  quietly apt-install "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends $missing ||
    give_up "system packages are missing: $missing"
}

# The first Python that is new enough and can make a virtual environment
find_python() {
  local python
  for python in python3 /usr/bin/python3; do
    if "$python" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' \
      2>/dev/null; then
      printf '%s\n' "$python"
      return
    fi
  done
  return 1
}

# What the Python environment is made from, as one line
python_recipe() {
  {
    pwd
    cat decks/setup.sh preprocessor/pyproject.toml postprocessor/pyproject.toml
    cat tests/requirements.txt manual/site/requirements.txt
  } | sha256sum
}

# install_python_packages WORD...: as pip understands them; by uv, which takes a part of its time, or by
# pip where uv cannot be had
install_python_packages() {
  local compile=()
  # at once where interpreters may not write what they compile, and each would compile it again
  [[ -z ${PYTHONDONTWRITEBYTECODE:-} ]] || compile=(--compile-bytecode)
  if quietly uv .venv/bin/python -m pip install uv 2>/dev/null &&
    quietly uv-packages .venv/bin/uv pip install --python .venv/bin/python "${compile[@]}" "$@" 2>/dev/null; then
    return
  fi
  say "not by uv ($logs/uv*.log say why); going on with pip"
  quietly pip .venv/bin/python -m pip install "$@"
}

# make_venv USE...: .venv with both packages, editable, and with the tools of the tests
make_venv() {
  local use python recipe fresh=yes extra='' wanted=()
  recipe=$(python_recipe)
  for use in "$@"; do
    grep -qsx "$recipe" ".venv/made-for-$use" || fresh=no
    if [[ $use == test ]]; then
      extra='[test]'
      wanted=(--requirement tests/requirements.txt)
    fi
  done
  wanted+=(--editable "preprocessor$extra" --editable "postprocessor$extra")
  if [[ $fresh == yes ]]; then
    return
  fi
  if ! .venv/bin/python -m pip --version >/dev/null 2>&1; then
    python=$(find_python) || give_up "Python 3.11 or later with its venv module is needed"
    say "making .venv"
    quietly venv "$python" -m venv --clear .venv || give_up "there is no virtual environment"
  fi
  say "installing the Python packages into .venv"
  if install_python_packages "${wanted[@]}"; then
    for use in "$@"; do
      printf '%s\n' "$recipe" >".venv/made-for-$use"
    done
  elif has_python_packages "$@"; then
    say "the Python packages could not be refreshed; going on with those in .venv"
  else
    give_up "the Python packages could not be installed"
  fi
}

# has_python_packages USE...: whether .venv could do without a visit to the network
has_python_packages() {
  .venv/bin/python -c 'import plydyn_pre, plydyn_post' 2>/dev/null || return 1
  [[ " $* " != *" test "* ]] || .venv/bin/python -c 'import pytest, xdist' 2>/dev/null
}

# build PRESET TARGET OPTION...: configure with the options and compile into build/PRESET
build() {
  local preset=$1 target=$2
  shift 2
  say "building $target in build/$preset"
  quietly "configure-$preset" cmake --preset "$preset" "$@" || return 1
  quietly "build-$preset" cmake --build --preset "$preset" --target "$target"
}
