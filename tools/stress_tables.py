#!/usr/bin/python3
"""docs/data/stress.md, docs/data/stability_map.csv, docs/data/violent_motions.csv, docs/data/local_volume.csv and the pictures
stability_map.svg, violent_motions.svg and local_volume.svg in docs/images from the results of the stress suite.

    tools/stress_tables.py output/stress
"""
import argparse
import collections
import csv
import json
import pathlib
import shutil

import local_volume_figure
import package  # noqa: F401
import violent_map_figure

ROOT = pathlib.Path(__file__).resolve().parents[1]
TITLES = {"scenes": "Random scenes", "ramps": "Ramps, near-inversion, coincident axes, steps about the limit",
          "units": "Other units", "long": "Long times", "mutants": "Damaged files", "interruptions": "Interruptions",
          "tolerances": "Tolerances", "quadrature": "Quadrature", "rows": "Rows of compared sweeps", "map": "Map of stability",
          "violent": "Violent releases", "volume": "Local volume"}


def number(value):
    return f"{value:.2g}" if isinstance(value, float) else str(value)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(map(number, row)) + " |" for row in rows] + [""]


def of_kinds(results):
    rows = []
    for name, kind in results["kinds"].items():
        ends = kind["endings"]
        rows.append((name, kind["runs"], ends.get("done", 0), ends.get("refused", 0), ends.get("stopped", 0),
                     ends.get("interrupted after the time limit", 0), kind["faults"]))
    rows.append(("**together**", *(sum(row[i] for row in rows) for i in range(1, 7))))
    return table(("case", "runs", "exit 0", "exit 2", "exit 3", "too long, interrupted", "faults"), rows)


def of_reasons(results):
    """Why runs stopped, and what became of them with a step of a quarter."""
    reasons = collections.defaultdict(collections.Counter)
    for record in results["records"]:
        if record.get("code") == 3 and record.get("reason"):
            reasons[record["reason"]][record.get("resumed") or "not tried"] += 1
    if not reasons:
        return []
    rows = [(reason, sum(after.values()), ", ".join(f"{n} {what}" for what, n in sorted(after.items())))
            for reason, after in sorted(reasons.items(), key=lambda item: -sum(item[1].values()))]
    return ["Why runs stopped (# a number), and how they ended when resumed with a quarter of the step:", "",
            *table(("reason", "runs", "resumed"), rows)]


def of_long(results):
    rows = []
    for record in results["records"]:
        for model in ("reduced", "continuum"):
            if f"{model} steps" in record:
                rows.append((record["kind"], record["name"], model, record[f"{model} steps"], record[f"{model} first half"],
                             record[f"{model} second half"], record[f"{model} drift"]))
    return ["Departure of the energy from its start, over the largest kinetic energy; drift: mean of the last quarter less "
            "mean of the first:", "",
            *table(("run", "", "model", "steps", "first half", "second half", "drift"), rows)]


def of_units(results):
    worst = collections.defaultdict(list)
    for record in results["records"]:
        if record.get("difference") not in ("", None):
            worst[record["kind"]].append(record["difference"])
    return ["Largest difference of a column, relative to the largest value of its quantity, over all factors:", "",
            *table(("scene", "other units", "largest difference"), [(name, len(d), max(d)) for name, d in worst.items()])]


def of_tolerances(results):
    held = collections.defaultdict(list)
    for record in results["records"]:
        if record["of_estimate"] != "":
            held[record["kind"]].append(record)
    return ["The largest error of Q over the samples, as a part of Time/Tolerance and of the estimate that the run prints:", "",
            *table(("model", "scenes", "of the tolerance", "of the estimate"),
                   [(kind, len(records), *(max(r[part] for r in records) for part in ("of_tolerance", "of_estimate")))
                    for kind, records in sorted(held.items())])]


DETAILS = {"scenes": of_reasons, "ramps": of_reasons, "long": of_long, "units": of_units,
           "tolerances": of_tolerances}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path)
    results = parser.parse_args().results
    page = ["# Tables of the stress suite", "", "Written by `scripts/stress.sh`; [testing.md](../testing.md) says what is tested.", ""]
    for part, title in TITLES.items():
        path = results / f"{part}.json"
        if not path.is_file():
            continue
        part_results = json.loads(path.read_text())
        page += [f"## {title}", "", f"{part_results['program']}, {part_results['date']}, seed {part_results['seed']}, "
                 f"{part_results['seconds'] / 60:.0f} min", "", *of_kinds(part_results), *(DETAILS[part](part_results) if part in DETAILS else [])]
    (ROOT / "docs/data/stress.md").write_text("\n".join(page).rstrip() + "\n")
    if (results / "map.csv").is_file():
        data = ROOT / "docs/data/stability_map.csv"
        shutil.copy(results / "map.csv", data)
        from pseudorigid import stability_map

        stability_map.write(data, ROOT / "docs/images/stability_map.svg")
    violent = ROOT / "docs/data/violent_motions.csv"
    if join([results / f"{part}.csv" for part in ("violent", "violent-high", "violent-map")], violent):
        violent_map_figure.write(violent, ROOT / "docs/images/violent_motions.svg")
    if (results / "volume.csv").is_file():
        data = ROOT / "docs/data/local_volume.csv"
        shutil.copy(results / "volume.csv", data)
        local_volume_figure.write(data, ROOT / "docs/images/local_volume.svg")


def join(paths, joined):
    """Writes the rows of those tables that exist, if there are any. Of two rows of a scene the first one stays, unless its run was
    too long. True if it wrote."""
    scenes = {}
    for path in filter(pathlib.Path.is_file, paths):
        for row in csv.DictReader(path.open()):
            scene = tuple(row[name] for name in ("degree", "gamma", "stretch", "spin", "law"))
            if scene not in scenes or scenes[scene]["outcome"] == "long":
                scenes[scene] = row
    rows = list(scenes.values())
    if rows:
        with open(joined, "w", newline="") as file:
            writer = csv.DictWriter(file, list(dict.fromkeys(column for row in rows for column in row)), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return bool(rows)


if __name__ == "__main__":
    main()
