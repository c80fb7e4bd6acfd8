# Shared by the scripts beside it and .ci/run, which source it: the packages of Debian that the build needs, and the
# steps install, configure, build. Every step costs next to nothing when there is nothing to do.
# shellcheck shell=bash disable=SC2034  # the lists are read by the scripts

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
reduced_packages=(g++ cmake ninja-build libeigen3-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libcli11-dev
  libmuparser-dev zlib1g-dev)
continuum_packages=(libdeal.ii-dev libsuitesparse-dev libopenblas0-serial)
test_packages=(libgtest-dev libgmock-dev libboost-dev python3-markdown-it python3-matplotlib python3-meshio python3-pandas
  python3-pip python3-setuptools python3-vtk9 python3-wheel)
benchmark_packages=(libgsl-dev libboost-dev libsundials-dev libbenchmark-dev python3-matplotlib)
log_directory=$root/build/log

say() { printf '== %s\n' "$*" >&2; }

# Exit code 2 everywhere means: the user can mend it, and this is how.
die() {
  printf 'error: %s\n' "$*" >&2
  exit 2
}

# usage FILE: the comment at the head of a script is its help.
usage() { sed -n '2,/^[^#]/ { s/^# \{0,1\}//p }' "$1"; }

# n_jobs: one a core, but not more than memory allows (twelve sources compiled together take up to about 2.4 GB).
n_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 2400000) }' /proc/meminfo)
  ((memory < cores)) && cores=$memory
  ((cores < 1)) && cores=1
  echo "$cores"
}

# report_failure WHAT LOG: the end of a log, which nobody saw as long as all went well.
report_failure() {
  printf 'error: %s; the end of %s:\n' "$1" "$2" >&2
  tail -n 25 "$2" >&2
}

# missing_packages PACKAGE…: prints those that are not installed.
missing_packages() {
  local installed
  installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
    sed -n 's/^installed //p') || true
  comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<<"$installed")
}

# install_packages PACKAGE…: installs what is missing, and asks for no rights when nothing is.
install_packages() {
  local missing as_root=()
  if ! command -v dpkg-query >/dev/null; then
    say "This is not Debian, so nothing is installed here; the build needs what Debian calls $*"
    return
  fi
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    # sudo may ask for a password only where somebody can answer.
    if ! command -v sudo >/dev/null || { ! sudo -n true 2>/dev/null && [[ ! -t 0 ]]; }; then
      die "packages are missing and installing them needs root; run as root:" \
        "apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    fi
    as_root=(sudo)
  fi
  say "Installing with apt-get: ${missing[*]}"
  mkdir -p "$log_directory"
  local log=$log_directory/apt-get.log attempt
  # Downloads of several hundred packages fail now and then; what was downloaded is not fetched again.
  for attempt in 1 2; do
    apt_get update && apt_get install -o APT::Status-Fd=1 --no-install-recommends "${missing[@]}" && return
    ((attempt == 2)) || say "The installation failed; once more in 5 seconds"
    sleep 5
  done
  report_failure "the installation failed twice" "$log"
  exit 2
}

# apt_get ARGUMENT…, for install_packages: no questions, progress in a few lines, the rest in a log. A machine of the
# integration server is thrown away afterwards: there dpkg need not force every file to the disk, which takes long.
apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get --yes -o Acquire::Retries=3 \
    -o DPkg::Lock::Timeout=300 ${CI:+-o DPkg::Options::=--force-unsafe-io} "$@" </dev/null 2>&1 |
    show_apt_progress "$log"
}

# show_apt_progress LOG: keeps apt's output, and turns its status lines (kind:package:percent:text) into one short line
# for every tenth of the way.
show_apt_progress() {
  local line tenth shown=
  while IFS= read -r line; do
    if [[ $line =~ ^(dl|pm)status:[^:]*:([0-9]+) ]]; then
      tenth="${BASH_REMATCH[1]} $((BASH_REMATCH[2] / 10 * 10)) %"
      if [[ $tenth != "$shown" && $tenth != *" 0 %" ]]; then
        sed 's/^dl/   downloaded/; s/^pm/   installed/' <<<"$tenth" >&2
      fi
      shown=$tenth
    else
      printf '%s\n' "$line"
    fi
  done >"$1"
}

# is_configured PRESET: the build directory is complete, was made for this copy of the sources, and is newer than the
# lists of packages above.
is_configured() {
  [[ $root/build/$1/build.ninja -nt $root/scripts/lib.sh ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$root/build/$1/CMakeCache.txt"
}

# configure PRESET [CMAKE ARGUMENT…]
configure() {
  local log=$log_directory/configure-$1.log fresh=()
  # What an incomplete attempt did not find must not be remembered.
  is_configured "$1" || fresh=(--fresh)
  mkdir -p "$log_directory"
  say "Configuring build/$1"
  cmake -S "$root" --preset "$1" "${fresh[@]}" "${@:2}" >"$log" 2>&1 || {
    report_failure "cmake failed" "$log"
    exit 1
  }
}

# build PRESET [TARGET…]: silent unless something has to be compiled (but for build_info.cpp, which is always on the list
# because the commit may have changed).
build() {
  local directory=$root/build/$1 n_files options=(--quiet)
  n_files=$(ninja -C "$directory" -n "${@:2}" | grep -c '^\[.*\] Building') || true
  if ((n_files > 1)); then
    say "Building ${*:2} in build/$1 ($n_files files, $(n_jobs) at a time)"
    options=(-j "$(n_jobs)" ${CI:+-k 0})  # the server shows all errors at once
  fi
  NINJA_STATUS='[%f/%t, %e s] ' ninja -C "$directory" "${options[@]}" "${@:2}" >&2
}

# install_while_building PACKAGE…: installs what is missing for the finite elements and the tests. Before the first build,
# it meanwhile builds what needs none of them, since apt-get mostly waits for the network and the disk. This needs rights
# without a question.
install_while_building() {
  local missing installer
  mapfile -t missing < <(missing_packages "$@" 2>/dev/null)
  if ((${#missing[@]} == 0 || EUID != 0)) || is_configured release || ! command -v dpkg-query >/dev/null; then
    install_packages "$@"
    return
  fi
  # Ctrl-C would end the build alone, because ninja turns it into a failure.
  trap 'say "Interrupted"; exit 130' INT
  install_packages "$@" &
  installer=$!
  build_without_finite_elements || true  # its errors are those of the whole build
  wait "$installer"
  trap - INT
}

# The objects serve the whole build. Without its build.ninja, the folder counts as not configured.
build_without_finite_elements() (
  trap 'rm -f "$root/build/release/build.ninja"' EXIT
  configure release -DPSEUDORIGID_CONTINUUM=OFF -DPSEUDORIGID_TESTS=OFF -DPSEUDORIGID_WERROR="${PSEUDORIGID_WERROR:-OFF}"
  build release pseudorigid
)
