#!/usr/bin/env bash
# Makes every picture and every printed number of the documentation again: scripts/documentation.sh [PART …]
#
# Installs what is missing (Debian 12; as root or with sudo), builds the program and writes into docs/ and README.md;
# `git diff` then shows what has changed. Parts (default: pages, pictures and benchmarks; "all": every one):
#   pages       docs/parameters.md, docs/data/equilibria.md, what commands print in README.md and in pages of docs/
#   pictures    docs/images: quickstart, phase portrait, cells, report, equilibria, gallery, tidal locking; not
#               paraview.png, because ParaView takes the place of python3-vtk9 (docs/python.md)
#   site        build/site: the pages with search and formulas, its links checked
#   verification  docs/images/verification.svg and the table of docs/verification.md
#   benchmarks  scripts/benchmark.sh, 25 minutes
#   long-run    scripts/benchmark.sh long-run, 15 minutes
#   stress      scripts/stress.sh --fresh, half an hour
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

drawing_packages=(chromium python3-matplotlib python3-pil python3-vtk9 xvfb xauth libgl1-mesa-dri)
parts=()
for part in "${@:-default}"; do
  case $part in
    -h | --help)
      usage "${BASH_SOURCE[0]}"
      exit
      ;;
    default) parts+=(pages pictures benchmarks) ;;
    all) parts+=(pages pictures verification site benchmarks long-run stress) ;;
    pages | pictures | site | verification | benchmarks | long-run | stress) parts+=("$part") ;;
    *) die "unknown part \"$part\"; parts are pages, pictures, site, verification, benchmarks, long-run, stress, or all" ;;
  esac
done

install_packages "${reduced_packages[@]}" "${continuum_packages[@]}" python3-meshio python3-pandas "${drawing_packages[@]}"
is_configured release || configure release -DPSEUDORIGID_TESTS=OFF
build release pseudorigid pseudorigid-continuum
cd "$root"
program=build/release/bin/pseudorigid
export PYTHONPATH=$root/python

make_pages() {
  "$program" parameters --format markdown >docs/parameters.md
  /usr/bin/python3 -m pseudorigid equilibria --program "$program" >docs/data/equilibria.md
  tools/print_pages.py "$program"
}

make_pictures() {
  local images=docs/images runs=output/documentation
  "$program" run params/quickstart.prm --output "$runs/quickstart"
  MPLBACKEND=Agg /usr/bin/python3 python/examples/analyse_run.py "$runs/quickstart"
  mv "$runs/quickstart/phase_portrait.svg" "$images"
  /usr/bin/python3 -m pseudorigid plot "$runs/quickstart" --quantity Q33 --output "$images/quickstart_curves.svg"
  "$program" run params/quickstart.prm --output "$runs/fine" --set "Continuum/Refinements=1" --set "Time/End=7" \
    --set "Output/Samples=140" --set "Output/Frames=29"
  xvfb-run -a /usr/bin/python3 -m pseudorigid render "$runs/fine" --output "$images/quickstart.png"
  xvfb-run -a /usr/bin/python3 -m pseudorigid animate "$runs/fine" --output "$images/both_balls.gif"
  "$program" run params/tidal_locking.prm --output "$runs/locking" --set "Time/End=60" --set "Output/Samples=120"
  /usr/bin/python3 -m pseudorigid orbit "$runs/locking" --width 640 --output "$images/tidal_locking.gif"
  for cells in linear lagrange; do
    "$program" run params/quickstart.prm --output "$runs/$cells" --set "Time/End=7" --set "Output/Samples=140" \
      --set "Output/Frames=29" --set "Output/Cells=$cells"
  done
  xvfb-run -a /usr/bin/python3 -m pseudorigid cells "$runs"/{linear,lagrange}/graphics/continuum-000028.vtu --output "$images/cells.png"
  "$program" run params/quickstart.prm --output "$runs/report" --set "Output/Report=true"
  tools/page_picture.py "$runs/report/report.html" --output "$images/report.png" --size 1200x960
  "$program" run params/sweep_of_releases.prm --output "$runs/map" --set "Output/Report=true"
  tools/page_picture.py "$runs/map/report.html" --output "$images/report_map.png" --size 1200x610
  tools/concepts_figure.py "$program" --run "$runs/concepts"
  /usr/bin/python3 -m pseudorigid equilibria --program "$program" --output "$images/equilibria.svg"
  "$program" run params/spinning_figures.prm --output "$runs/campbell" --set "Equilibrium/First=0.1" \
    --set "Equilibrium/Last=1.9" --set "Equilibrium/Number=10"
  /usr/bin/python3 -m pseudorigid campbell "$runs/campbell" --output "$images/campbell.svg"
  xvfb-run -a tools/gallery.py "$program" --output "$images/gallery" --runs "$runs/gallery"
}

make_site() {
  install_packages python3-myst-parser libjs-katex
  tools/site_of_pages.py build/site
}

for part in "${parts[@]}"; do
  case $part in
    pages) make_pages ;;
    pictures) make_pictures ;;
    site) make_site ;;
    verification) tools/verification.py "$program" --runs output/documentation/verification ;;
    benchmarks) scripts/benchmark.sh ;;
    long-run) scripts/benchmark.sh long-run ;;
    stress) scripts/stress.sh --fresh ;;
  esac
done
