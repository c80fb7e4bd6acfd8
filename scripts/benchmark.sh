#!/usr/bin/env bash
# Measures run time against error and writes the page of benchmarks: scripts/benchmark.sh [option …] [PART …]
#
# Installs what is missing (Debian 12; as root or with sudo), builds the benchmarks in build/release, measures, and
# writes data, pictures and docs/benchmarks/index.html, and the tables of README.md and of pages of docs/. About 25 minutes
# on 2 cores in addition to installing and building. Parts (default: all but long-run):
#   small-systems  the reduced model, a rigid body, a double pendulum, a fluid: all methods, GSL, odeint, SUNDIALS
#   methods     single calls of forces and of self-gravity
#   release     nonlinear release of the ball: methods, degrees, refinements, tolerances
#   ladder      the release by polynomial bodies and finite elements, whole processes
#   gravity     the release under the ball's own gravity; what the pairs of surface points cost
#   lamb        small affine release against the exact modes
#   frequency   the lowest frequency of the ball
#   auto        degree and refinements from a tolerance, beside the cheapest found by hand
#   kernels     cell kernels against dealii::FEEvaluation and the limits of the machine
#   steps       what a step costs, with the number of unknowns, the degree and two ranks; iterations of Gram solves
#   scaling     messages and reductions of a step on 1, 2 and 4 ranks, for a model of runs on many cores; figures on 2 ranks
#   skipping    what the scenes of params/ skip, and what it would have cost
#   midpoint    the release by the implicit midpoint rule inside the program
#   bulk        both forms of the bulk term of a nearly incompressible ball
#   peers       the nonlinear release by FEniCSx and GetFEM, where their packages are installed, and small systems by SciPy
#   modes       the frequencies of the ball by the program and by FEniCSx with SLEPc
#   figures     a ball at rest by the program, by FEniCSx and by GetFEM
#   ranks       steps of the program and of FEniCSx on one and on two ranks
#   long-run    a million periods of the reduced model: 15 minutes more
# Options:
#   --quick         all parts in about 3 minutes, for a look; results in build/benchmarks-quick
#   --output DIR    data, pictures and page there; the documentation stays as it is
#   --page-only     the page and the tables from data of earlier runs
# Other work on the machine disturbs; the page tells the load when each part began.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

all_parts=(small-systems methods release ladder gravity lamb frequency auto kernels steps scaling skipping midpoint bulk peers modes figures ranks)
parts=()
quick=()
output=
page_only=
while (($#)); do
  case $1 in
    -h | --help)
      usage "${BASH_SOURCE[0]}"
      exit
      ;;
    --quick) quick=(--quick) ;;
    --page-only) page_only=yes ;;
    --output)
      (($# > 1)) || die "--output wants a directory"
      output=$2
      shift
      ;;
    -*) die "unknown option $1; --help lists them" ;;
    *)
      [[ " ${all_parts[*]} long-run " == *" $1 "* ]] || die "unknown part $1; parts are ${all_parts[*]} long-run"
      parts+=("$1")
      ;;
  esac
  shift
done
((${#parts[@]})) || parts=("${all_parts[@]}")
if ((${#quick[@]})); then output=${output:-$root/build/benchmarks-quick}; fi
page_options=(--output "$output")
if [[ -z $output ]]; then
  output=$root/docs/benchmarks
  page_options=()
fi
data=$output/data
bin=$root/build/release/bin
program=$bin/pseudorigid

# into FILE COMMAND…: standard output becomes the file when all went well, and is gone otherwise.
into() {
  "${@:2}" >"$data/$1.part" && mv "$data/$1.part" "$data/$1" && return
  rm -f "$data/$1.part"
  return 1
}

measure_small_systems() { "$bin/work_precision" "${quick[@]}" --output "$data/work_precision.csv"; }

measure_methods() {
  local options=(--benchmark_format=csv --benchmark_report_aggregates_only=true --benchmark_repetitions=5)
  if ((${#quick[@]})); then options=("${options[@]:0:2}" --benchmark_repetitions=3 --benchmark_min_time=0.02); fi
  # Calls only: Google Benchmark's CSV wants the same counters in all, and steps have their own. It describes the machine
  # at length on standard error.
  into single_calls.csv "$bin/micro" "${options[@]}" "--benchmark_filter=right_hand_side|force" 2>"$log_directory/micro.log"
  into self_gravity.csv "$bin/self_gravity" "${options[@]}" 2>"$log_directory/self_gravity.log"
}

measure_release() { into ball_release.csv "$root/benchmarks/ball_release.py" "$program" "${quick[@]}"; }

measure_ladder() { into ladder.csv "$root/benchmarks/ladder.py" "$program" "${quick[@]}"; }

# Degree, refinements, steps.
gravity_cases=("4 0 200" "4 1 100" "4 2 40" "4 3 10")
ball_gravity() {
  local case cases=("${gravity_cases[@]}")
  if ((${#quick[@]})); then cases=("${cases[@]:0:2}"); fi
  for case in "${cases[@]}"; do
    # shellcheck disable=SC2086 # three words
    "$bin/ball_gravity" $case
  done | awk 'NR == 1 || !/^degree/'
}
measure_gravity() {
  into gravitating_release.csv "$root/benchmarks/ball_release.py" "$program" --gravity "${quick[@]}"
  into ball_gravity.csv ball_gravity
}
measure_lamb() { into lamb_response.csv "$bin/lamb_response" "${quick[@]}"; }
measure_frequency() { into ball_frequency.csv "$bin/ball_frequency" "${quick[@]}"; }
measure_auto() { into auto_discretization.csv "$root/benchmarks/auto_discretization.py" "$program" "${quick[@]}"; }
# The forces of kernels.csv, and those on a mesh that fits into the cache.
forces() {
  grep "^#\|^degree\|FEEvaluation\|,force," "$data/kernels.csv"
  "$bin/kernels" 4 4 1000 | grep "FEEvaluation\|,force,"
}
measure_kernels() {
  if ((${#quick[@]})); then into kernels.csv "$bin/kernels" 4; else into kernels.csv "$bin/kernels" 2 8; fi
  # A table for each kind of processor.
  into "fe_evaluation_$(grep -qm1 AuthenticAMD /proc/cpuinfo && echo amd || echo intel).csv" forces
}

# Degree and refinements, ranks, preconditioner, steps. Lines of the header but the first are left out.
step_cases=("2 2 1 auto 40" "3 2 1 auto 40" "4 1 1 auto 40" "4 2 1 auto 40" "4 3 1 auto 20" "6 1 1 auto 40"
  "6 2 1 auto 20" "8 1 1 auto 20" "4 3 2 auto 20" "6 3 1 auto 10")
quick_step_cases=("2 2 1 auto 20" "4 1 1 auto 20" "6 1 1 auto 20" "4 2 1 auto 20" "4 2 2 auto 20")
ball_steps() {
  local degree refinements ranks gram n_steps launcher case cases=("${step_cases[@]}")
  if ((${#quick[@]})); then cases=("${quick_step_cases[@]}"); fi
  for case in "${cases[@]}"; do
    read -r degree refinements ranks gram n_steps <<<"$case"
    launcher=()
    if ((ranks > 1)); then
      # Not nproc, which says 1 where OMP_NUM_THREADS is 1.
      if ! command -v mpirun >/dev/null || (($(getconf _NPROCESSORS_ONLN) < ranks)); then continue; fi
      launcher=(mpirun -np "$ranks")
    fi
    "${launcher[@]}" "$bin/ball_steps" "$degree" "$refinements" "$gram" "$n_steps"
  done | awk 'NR == 1 || !/^degree/'
}
measure_steps() {
  into ball_steps.csv ball_steps
  if ((${#quick[@]})); then into gram_iterations.csv "$bin/gram_iterations" 2; else into gram_iterations.csv "$bin/gram_iterations"; fi
}
measure_scaling() {
  if command -v mpirun >/dev/null; then
    into scaling.csv "$root/benchmarks/scaling.py" "$program" "${quick[@]}"
    into figure_ranks.csv "$root/benchmarks/figure_ranks.py" "$program" "${quick[@]}"
  else
    not_measured=1
  fi
}
measure_skipping() { into skipping.csv "$root/benchmarks/skipping.py" "$program" "${quick[@]}"; }

# Name of a program, prefix of its files, packages, options unless --quick is given.
measure_release_by() {
  local script="$root/benchmarks/peers/$2_release.py" packages options=("${quick[@]}")
  if ((!${#quick[@]})); then options=("${@:4}"); fi
  left_out=yes
  read -ra packages <<<"$3"
  if [[ -n $(missing_packages "${packages[@]}") ]]; then
    say "$1 is left out: apt-get install --no-install-recommends $3"
  elif into "$2_release.csv" /usr/bin/python3 "$script" "${options[@]}"; then
    left_out=
    if ((!${#quick[@]})); then into "$2_sizes.csv" /usr/bin/python3 "$script" --sizes || say "$1 failed for large meshes"; fi
  else
    say "$1 failed; its earlier results stay"
  fi
}

# What is not of this project may be missing or fail: then its earlier results stay, with their date.
measure_peers() {
  not_measured=1
  if [[ -n $(missing_packages python3-scipy) ]]; then
    say "SciPy is left out: apt-get install --no-install-recommends python3-scipy"
  else
    into scipy_small_systems.csv /usr/bin/python3 "$root/benchmarks/peers/scipy_small_systems.py" "${quick[@]}" ||
      say "SciPy failed; its earlier results stay"
  fi
  measure_release_by FEniCSx fenicsx python3-dolfinx-real --reference "$data/fenicsx_reference.csv"
  [[ -n $left_out ]] || not_measured=
  measure_release_by GetFEM getfem "python3-getfem++ python3-scipy python3-petsc4py"
  # Only runs of one day and machine belong into one table.
  if [[ -z $not_measured && -z $left_out && " ${parts[*]} " == *" release "*" midpoint "* ]]; then
    into three_programs.csv "$root/benchmarks/peers/three_programs.py" "$data"
  fi
  if ((!${#quick[@]})); then into release_sizes.csv "$root/benchmarks/release_sizes.py" "$program"; fi
}

measure_midpoint() { into implicit_midpoint.csv "$bin/implicit_midpoint" "${quick[@]}"; }
measure_bulk() { into nearly_incompressible.csv "$root/benchmarks/nearly_incompressible.py" "$program" "${quick[@]}"; }

# The rest is compared with FEniCSx, and is left out without it.
has_fenicsx() {
  [[ -z $(missing_packages python3-dolfinx-real python3-scipy) ]] && return
  say "$1 is left out: apt-get install --no-install-recommends python3-dolfinx-real python3-scipy"
  not_measured=1
  return 1
}
measure_modes() {
  has_fenicsx modes || return 0
  into mode_cost.csv env PSEUDORIGID="$program" "$root/benchmarks/mode_cost.py" "${quick[@]}"
  into fenicsx_modes.csv /usr/bin/python3 "$root/benchmarks/peers/fenicsx_modes.py" "${quick[@]}"
}
measure_figures() {
  has_fenicsx figures || return 0
  into static_figure.csv "$root/benchmarks/static_figure.py" "$program" "${quick[@]}"
  into fenicsx_static.csv /usr/bin/python3 "$root/benchmarks/peers/fenicsx_static.py" "${quick[@]}"
  local packages=(python3-getfem++ python3-scipy python3-petsc4py)
  if [[ -n $(missing_packages "${packages[@]}") ]]; then
    say "GetFEM is left out: apt-get install --no-install-recommends ${packages[*]}"
  else
    into getfem_static.csv /usr/bin/python3 "$root/benchmarks/peers/getfem_static.py" "${quick[@]}" ||
      say "GetFEM failed; its earlier results stay"
  fi
}
measure_ranks() {
  has_fenicsx ranks || return 0
  if ! command -v mpirun >/dev/null || (($(getconf _NPROCESSORS_ONLN) < 2)); then
    not_measured=1
    return 0
  fi
  into fenicsx_ranks.csv /usr/bin/python3 "$root/benchmarks/peers/fenicsx_ranks.py" "${quick[@]}"
  if ((!${#quick[@]})); then into release_ranks.csv "$root/benchmarks/release_sizes.py" "$program" --ranks; fi
}

measure_long_run() {
  into long_run_summary.csv "$bin/long_run" "${quick[@]}" --output "$data/long_run.csv"
}

mkdir -p "$data" "$log_directory"
if [[ -z $page_only ]]; then
  install_packages "${reduced_packages[@]}" "${continuum_packages[@]}" "${benchmark_packages[@]}"
  # A tree that has tests keeps them; the benchmarks are in no default target, so that scripts/test.sh does not build them.
  fresh=()
  is_configured release || fresh=(-DPSEUDORIGID_TESTS=OFF)
  configure release -DPSEUDORIGID_BENCHMARKS=ON "${fresh[@]}"
  build release pseudorigid pseudorigid-continuum benchmarks
  # Numerical libraries that would start threads must not: everything here runs on one core unless it says otherwise.
  # (Not before the build: nproc says 1 where OMP_NUM_THREADS is 1.)
  export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  # All programs have the kernels of OpenBLAS that pseudorigid selects. OpenBLAS does not know the newest processors.
  if grep -qw avx512vl /proc/cpuinfo; then
    export OPENBLAS_CORETYPE=SKYLAKEX
  elif grep -qw avx2 /proc/cpuinfo; then
    export OPENBLAS_CORETYPE=HASWELL
  fi
  for part in "${parts[@]}"; do
    say "Measuring: $part"
    read -r load _ </proc/loadavg
    start=$SECONDS
    not_measured=
    "measure_${part//-/_}"
    [[ -n $not_measured ]] || "$root/benchmarks/machine.py" "$data" "$part" "$((SECONDS - start))" "$load" "$program" "${quick[@]}"
    say "$part took $((SECONDS - start)) s"
  done
fi
"$root/tools/benchmark_page.py" "${page_options[@]}"
say "The page is $output/index.html"
