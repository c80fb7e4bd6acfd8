#!/usr/bin/env bash
# Runs scenes: scripts/run.sh [SCENE.prm …] [option of `pseudorigid run` …]
#
# Installs what is missing (Debian 12; as root or with sudo), builds the program, and runs each scene in turn;
# without a scene, params/quickstart.prm. Every option is handed to `pseudorigid run`:
#   --set "Section/Entry=value"   change an entry of the scene (may be repeated)
#   --output DIR                  where the results go
#   --resume, --quiet, --verbose  continue an interrupted run; say less or more
# A second call starts at once. Stops at the first scene that fails, with its exit code.
# Each run ends with the path of its report, a page for a browser. It is written unless the scene or an option sets
# Output/Report; it costs about a tenth of a second and a megabyte.
#
# Examples:
#   scripts/run.sh
#   scripts/run.sh params/quickstart.prm --set "Time/End=20" --output /tmp/results
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# entry NAME SCENE: the value of an entry outside subsections, if the text sets it.
entry() { sed -nE "s/^[[:space:]]*set[[:space:]]+$1[[:space:]]*=[[:space:]]*([^#]*[^#[:space:]]).*/\\1/p" "$2"; }

# discretized_models: the models that need deal.II, each named as its file in the table of models.
discretized_models() { grep -l 'discretized = true' "$root"/src/app/models/*.cpp | xargs -n 1 basename -s .cpp; }

# may_need_continuum SCENE: false only if the text sets Models without any that needs it, or another System than the
# ball, and nothing can overrule it.
may_need_continuum() {
  local system models model
  if [[ ${options[*]} == *Models* || ${options[*]} == *System* ]] || grep -qiE '^[[:space:]]*include' "$1"; then return 0; fi
  system=$(entry System "$1")
  [[ ${system:-ball} == ball ]] || return 1
  models=$(entry Models "$1")
  [[ $models ]] || return 0
  for model in $(discretized_models); do
    if [[ $models == *$model* ]]; then return 0; fi
  done
  return 1
}

# sets_report SCENE: whether the scene or an option decides about the report.
sets_report() { [[ ${options[*]} == *Report* ]] || grep -qE '^[[:space:]]*set[[:space:]]+Report[[:space:]]*=' "$1"; }

scenes=()
options=()
while (($#)); do
  case $1 in
    -h | --help)
      usage "${BASH_SOURCE[0]}"
      exit
      ;;
    --set | --output)
      options+=("${@:1:2}")
      shift $(($# < 2 ? 1 : 2))
      ;;
    -*)
      options+=("$1")
      shift
      ;;
    *)
      scenes+=("$1")
      shift
      ;;
  esac
done
((${#scenes[@]})) || scenes=("$root/params/quickstart.prm")

# Asked before anything is installed or built. Scenes of the reduced model alone are spared deal.II (500 MB).
preset=reduced-only
for scene in "${scenes[@]}"; do
  [[ -f $scene && -r $scene ]] || die "cannot open the parameter file \"$scene\""
  if may_need_continuum "$scene"; then preset=release; fi
done
if is_configured release; then preset=release; fi

packages=("${reduced_packages[@]}")
targets=(pseudorigid)
if [[ $preset == release ]]; then
  packages+=("${continuum_packages[@]}")
  targets+=(pseudorigid-continuum)
fi
if ! is_configured "$preset"; then
  install_packages "${packages[@]}"
  configure "$preset" -DPSEUDORIGID_TESTS=OFF
fi
build "$preset" "${targets[@]}"

for scene in "${scenes[@]}"; do
  report=(--set Output/Report=true)
  if sets_report "$scene" || [[ ${options[*]} == *--resume* ]]; then report=(); fi
  "$root/build/$preset/bin/pseudorigid" run "$scene" "${options[@]}" "${report[@]}"
done
