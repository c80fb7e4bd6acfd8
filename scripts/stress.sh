#!/usr/bin/env bash
# The long stress suite: scripts/stress.sh [--quick] [--fresh] [--seed N] [--number N] [PART …]
#
# Installs what is missing (Debian 12; as root or with sudo), builds the program and runs the parts
#   scenes         random scenes of the ball and of the other systems (--number N, default 1000)
#   ramps          amplitudes to failure, near-inversion, coincident axes, steps about the stability limit
#   units          the same scenes in units of length, mass and time that are 1e±12 as large
#   long           10^7 steps of the reduced model, 10^5 of the continuum, releases over 100 periods
#   mutants        10,000 damaged parameter files, checkpoints and meshes each
#   interruptions  Ctrl-C, SIGTERM, SIGKILL, full disks, and how the runs go on
#   tolerances     short scenes with few samples: is the error below Time/Tolerance (--number N, default 1000)
#   quadrature     random motions of polynomial bodies: does the estimated error of their quadrature hold it
#                  (a quarter of --number N)
#   map            the map of stability
#   rows           rows of the samples of docs/adequacy.md: single runs and finer comparisons
#   violent        releases from large stretches: energy, local volume, Biot's limit
#   violent-high   the same with degrees 5 to 8, which takes hours
#   violent-map    the same with more stretches and gravities, with spins and with other laws; half an hour
#   volume         local volume and error of Q over degree, refinement and volumetric stiffness
#   sanitizers     the tests and damaged files above in a build with the address, leak and undefined behaviour
#                  sanitizers, sweeps in one with the thread sanitizer
# or all of them but violent-high, violent-map and the last without a name. Results are kept in output/stress, and a
# part whose results are there is not run again (--fresh: it is). --quick: the short form that ctest runs as well
# (ctest -L stress). At the end the tables docs/data/stress.md and docs/data/violent_motions.csv, and the pictures
# stability_map.svg, violent_motions.svg and local_volume.svg in docs/images with their data in docs/data are made from
# what is there, if nothing was run with --quick. Exit code 1: something was not as it must be.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

run_sanitizers() {
  configure asan -DPSEUDORIGID_TESTS=ON
  build asan all
  # Whose memory is lost is seen in whole stacks only, which Debian's libraries do not give to the fast unwinder.
  ASAN_OPTIONS=detect_leaks=1:fast_unwind_on_malloc=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 \
    LSAN_OPTIONS=print_suppressions=0:suppressions="$root/tests/support/open_mpi.supp" PSEUDORIGID_MUTANTS=10000 \
    ctest --test-dir "$root/build/asan" --output-on-failure -j "$(nproc)"
  # Threads are used by sweeps only, of systems without finite elements.
  configure tsan -DPSEUDORIGID_TESTS=ON
  build tsan pseudorigid
  TSAN_OPTIONS=halt_on_error=1 ctest --test-dir "$root/build/tsan" --output-on-failure --no-tests=error -R "^Sweeps|sweep"
}

options=(--output "$root/output/stress")
parts=()
quick=
sanitizers=
while (($#)); do
  case $1 in
    -h | --help)
      usage "${BASH_SOURCE[0]}"
      exit
      ;;
    --quick)
      quick=yes
      options=(--quick --output "$root/output/stress-quick")
      ;;
    --seed | --number)
      options+=("${@:1:2}")
      shift
      ;;
    -*) options+=("$1") ;;
    sanitizers) sanitizers=yes ;;
    *) parts+=("$1") ;;
  esac
  shift
done

install_packages "${reduced_packages[@]}" "${continuum_packages[@]}" "${test_packages[@]}"
if [[ $sanitizers ]]; then
  run_sanitizers
  ((${#parts[@]})) || exit 0
fi
configure release -DPSEUDORIGID_TESTS=ON
build release pseudorigid pseudorigid-continuum stress_mutants_test stress_prm_mutants_test io_checkpoint_test \
  io_test scene_oracle_test
export PSEUDORIGID=$root/build/release/bin/pseudorigid PSEUDORIGID_TESTS=$root/build/release/tests
code=0
/usr/bin/python3 "$root/tests/stress/stress.py" "${options[@]}" "${parts[@]}" || code=$?
if [[ ! $quick ]]; then
  /usr/bin/python3 "$root/tools/stress_tables.py" "$root/output/stress"
fi
exit "$code"
