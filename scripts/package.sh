#!/usr/bin/env bash
# Builds the packages pseudorigid and pseudorigid-dev for Debian: scripts/package.sh [DIRECTORY]
#
# Installs what is missing (Debian 12 or 13; as root or with sudo), builds the program for all processors
# (docs/install.md) and writes the two packages to DIRECTORY, or to build/package.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

if [[ ${1-} == -h || ${1-} == --help ]]; then
  usage "${BASH_SOURCE[0]}"
  exit
fi
directory=$(realpath -m "${1:-$root/build/package}")

install_packages "${reduced_packages[@]}" "${continuum_packages[@]}" dpkg-dev file
configure package
build package all
say "Making packages"
log=$log_directory/cpack.log
(cd "$root/build/package" && cpack -B "$directory") >"$log" 2>&1 || {
  report_failure "cpack failed" "$log"
  exit 1
}
rm -rf "$directory/_CPack_Packages"
ls "$directory"/pseudorigid*.deb
