#!/usr/bin/env bash
# Builds everything and runs the tests: scripts/test.sh [argument of ctest …]
#
# Installs what is missing (Debian 12; as root or with sudo). The exit code is ctest's. Every argument is handed to
# ctest:
#   -L unit       only the tests with a label (unit, convergence, stress, io)
#   -R NAME       only the tests whose name matches
#   -j N          so many at a time (default: one more than there are cores, because some tests wait)
# PSEUDORIGID_WERROR=ON in the environment makes warnings errors.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if [[ ${1-} == -h || ${1-} == --help ]]; then
  usage "${BASH_SOURCE[0]}"
  exit
fi

install_packages "${reduced_packages[@]}"
install_while_building "${continuum_packages[@]}" "${test_packages[@]}"
configure release -DPSEUDORIGID_CONTINUUM=ON -DPSEUDORIGID_TESTS=ON -DPSEUDORIGID_WERROR="${PSEUDORIGID_WERROR:-OFF}"
build release all
ctest --test-dir "$root/build/release" --output-on-failure --no-tests=error -j $(($(nproc) + 1)) "$@"
