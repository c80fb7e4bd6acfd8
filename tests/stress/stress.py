#!/usr/bin/python3
"""The stress suite: runs parts of it, prints how many runs of what ended how, and keeps a CSV and a JSON file of each.

    stress.py [PART …] [--quick] [--fresh] [--seed N] [--number N] [--output DIR]

Parts: scenes, ramps, units, long, mutants, interruptions, tolerances, quadrature, figures, map, rows, violent, violent-high, violent-map, volume; all
but violent-high and violent-map without a name. A part whose results are in DIR is not run again, unless --fresh. Exit code 1 if
anything was not as it must be. The program is that of the environment variable
PSEUDORIGID, test programs are those of PSEUDORIGID_TESTS; scripts/stress.sh sets both.
"""
import argparse
import collections
import csv
import datetime
import json
import pathlib
import shutil
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import compared_rows  # noqa: E402
import figures  # noqa: E402
import interruptions  # noqa: E402
import local_volume  # noqa: E402
import long_times  # noqa: E402
import mutants  # noqa: E402
import quadrature  # noqa: E402
import ramps  # noqa: E402
import random_scenes  # noqa: E402
import stability_map  # noqa: E402
import tolerances  # noqa: E402
import units  # noqa: E402
import violent  # noqa: E402
from program import Program  # noqa: E402

PARTS = {"scenes": random_scenes.run, "ramps": ramps.run, "units": units.run, "long": long_times.run,
         "mutants": mutants.run, "interruptions": interruptions.run, "tolerances": tolerances.run,
         "quadrature": quadrature.run, "figures": figures.run, "map": stability_map.run, "rows": compared_rows.run,
         "violent": violent.run, "violent-high": violent.run_high, "violent-map": violent.run_map, "volume": local_volume.run}
LONG_PARTS = ("violent-high", "violent-map")  # run by name only
N_SCENES = {True: 40, False: 1000}
ENDINGS = {0: "done", 2: "refused", 3: "stopped"}


def ending(record):
    if record.get("too_long"):
        return "interrupted after the time limit"
    return ENDINGS.get(record.get("code"), str(record.get("code", "done")))


def summary(records):
    """Of the kinds of a part: how many, how they ended, how many faults."""
    kinds = {}
    for record in records:
        kind = kinds.setdefault(record["kind"], {"runs": 0, "endings": collections.Counter(), "faults": 0})
        kind["runs"] += record.get("runs", 1)
        kind["endings"][ending(record)] += record.get("runs", 1)
        kind["faults"] += bool(record["faults"])
    return kinds


def show(part, results):
    print(f"{part}: {sum(k['runs'] for k in results['kinds'].values())} runs in {results['seconds']:.0f} s")
    for name, kind in results["kinds"].items():
        endings = ", ".join(f"{n} {what}" for what, n in sorted(kind["endings"].items()))
        print(f"  {name}: {kind['runs']} ({endings}); {kind['faults']} faults")
    for record in results["records"]:
        if record["faults"]:
            print(f"  FAULT {record['kind']} {record.get('name', record.get('number', ''))}: {record['faults']}")
    sys.stdout.flush()


def run_part(part, options, scratch):
    start, date = time.monotonic(), datetime.date.today().isoformat()
    number = options.number or N_SCENES[options.quick]
    program = Program(scratch / part)
    records = PARTS[part](program, number=number, seed=options.seed, quick=options.quick,
                          with_continuum=not options.reduced, output=options.output)
    return {"part": part, "program": program.version(), "date": date, "quick": options.quick, "seed": options.seed,
            "seconds": time.monotonic() - start, "kinds": summary(records), "records": records}


def keep(results, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{results['part']}.json").write_text(json.dumps(results, indent=1) + "\n")
    columns = list(dict.fromkeys(key for record in results["records"] for key in record))
    with open(folder / f"{results['part']}.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(results["records"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], metavar="PART")
    parser.add_argument("--quick", action="store_true", help="the short form, as ctest runs it")
    parser.add_argument("--fresh", action="store_true", help="run parts again whose results are there")
    parser.add_argument("--reduced", action="store_true", help="without the continuum")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--number", type=int, help="of random scenes")
    parser.add_argument("--output", type=pathlib.Path, help="where results are kept; without it they are not")
    options = parser.parse_args()
    n_faults = 0
    for part in options.parts or [part for part in PARTS if part not in LONG_PARTS]:
        kept = options.output and options.output / f"{part}.json"
        if kept and kept.exists() and not options.fresh:
            results = json.loads(kept.read_text())
            print(f"({kept} is there)")
        else:
            scratch = pathlib.Path(tempfile.mkdtemp(prefix="pseudorigid-stress-"))
            try:
                results = run_part(part, options, scratch)
            finally:
                shutil.rmtree(scratch, ignore_errors=True)
            if options.output:
                keep(results, options.output)
        show(part, results)
        n_faults += sum(kind["faults"] for kind in results["kinds"].values())
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())
