#!/usr/bin/env bash
# container.sh build|install: both stages of a container on Debian, from the top of a clone, as root.
# `build` makes a Debian package of the solver and wheels of plydyn-pre and plydyn-post in
# build/container. `install` needs only that folder and decks: it installs the package, and the
# wheels into /opt/plydyn.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# shellcheck source=decks/setup.sh
source decks/setup.sh

made=build/container

build_packages() {
  install_system_packages build python
  quietly apt-dpkg apt-get install -y --no-install-recommends dpkg-dev file
  build portable plydyn
  mkdir -p "$made"
  quietly cpack cpack -G DEB --config build/portable/CPackConfig.cmake -B "$made"
  quietly wheels python3 -m pip wheel --no-deps --wheel-dir "$made" ./postprocessor ./preprocessor
}

install_packages() {
  install_system_packages python
  quietly apt-deb apt-get install -y --no-install-recommends openmpi-bin "./$(ls "$made"/plydyn_*.deb)"
  quietly venv python3 -m venv /opt/plydyn
  quietly pip /opt/plydyn/bin/python -m pip install "$made"/*.whl
  ln -sf /opt/plydyn/bin/plydyn-pre /opt/plydyn/bin/plydyn-post /usr/local/bin
}

case ${1-} in
  build) build_packages ;;
  install) install_packages ;;
  *) give_up "container.sh build|install" ;;
esac
