"""Rows of sweeps of several models, drawn at random from the samples of docs/adequacy.md. Each row is a single run bit by bit. A finer
comparison has two degrees more, in the short form one, and a tenth of the tolerance. Its ratio of the frequencies and its largest
difference of Q lie within the error bars of the row, and every other difference within the bars of both."""
import json
import pathlib
import random
import re

from program import DONE, Table

FAMILIES = pathlib.Path(__file__).resolve().parents[2] / "params" / "adequacy"
N_ROWS = {True: 1, False: 30}
DEGREES_MORE = {True: 1, False: 2}  # of elements of degree 4
LONGEST = 120
MODELS = ("reduced", "polynomial")
ROUND_OFF = 1e-11
LEAST_BARS = 15
QUANTITIES = "Output/Quantities=state, energies, momenta, multiplier, axes, nonaffine, stretches, stresses"


def families():
    """(name of the scene, number of rows) of the Latin hypercubes."""
    return (("sample_release", 800), ("sample_gravity", 300), ("sample_compressible", 500))


def run_scene(program, family, name, *settings):
    folder = program.scratch / name
    options = [part for setting in (*settings, QUANTITIES) for part in ("--set", setting)]
    return program.call("run", FAMILIES / f"{family}.prm", "--output", folder, *options, folder=folder, limit=LONGEST)


def values_of(row, header):
    return dict(zip(header[1:header.index("compared")], row[1:]))


def as_numbers(text, values):
    """The scene's text with numbers in place of the parameters, and without the sweep."""
    lines = []
    for line in text.splitlines():
        if "Parameters" not in line and "$(" in line:
            before, *expressions = line.split("$(")
            line = before + "".join("$(" + replaced(expression, values) for expression in expressions)
        if "Parameters" not in line:
            lines.append(line)
    return "\n".join(lines) + "\n"


def replaced(expression, values):
    return re.sub(r"\b[a-z]+\b", lambda found: f"({values[found[0]]!r})" if found[0] in values else found[0], expression)


def judge_row(program, family, number, degree, record):
    part = f"{number} of {dict(families())[family]}"
    swept = run_scene(program, family, "swept", f"Sweep/Part={part}")
    if swept.code != DONE:
        record["faults"] = f"exit code {swept.code}: {swept.stderr.strip()[-200:]}"
        return
    table = Table(swept.folder / "sweep.csv")
    row = dict(zip(table.header, table.rows[0]))
    values = values_of(table.rows[0], table.header)
    scene = program.scratch / "single.prm"
    scene.write_text(as_numbers((FAMILIES / f"{family}.prm").read_text(), values))
    single, finer = (program.call("run", scene, "--output", program.scratch / name, "--set", QUANTITIES, *options,
                                  folder=program.scratch / name, limit=LONGEST)
                     for name, options in (("single", ()), ("finer", ("--set", f"Continuum/Degree={degree}",
                                                                      "--set", "Time/Tolerance=1e-5"))))
    if (single.code, finer.code) != (DONE, DONE):
        record["faults"] = f"exit codes {single.code}, {finer.code}"
        return
    faults = []
    for model in MODELS:
        own, fine = (json.loads((run.folder / f"comparison-{model}.json").read_text()) for run in (single, finer))
        found = {"frequency_ratio": own["frequency"]["ratio"] or 0, "q_difference_max": own["differences"]["q_difference"]["max"],
                 "strain_difference_rms": own["differences"]["strain_difference"]["rms"]}
        faults += [f"{model}_{name} is {row[f'{model}_{name}']!r} in the sweep and {value!r} alone"
                   for name, value in found.items() if row[f"{model}_{name}"] != value]
        bar, ratio = row[f"{model}_frequency_ratio_error"], fine["frequency"]["ratio"]
        if bar > 0 and ratio:
            record[f"{model}_ratio_of_bar"] = of_bar = abs(row[f"{model}_frequency_ratio"] - ratio) / bar
            if of_bar > 1:
                faults.append(f"a finer comparison has the ratio {ratio:.6g} in place of {found['frequency_ratio']:.6g} ± {bar:.1g}")
        bar = row[f"{model}_q_difference_error"]
        if bar > 0:
            of_bar = abs(row[f"{model}_q_difference_max"] - fine["differences"]["q_difference"]["max"]) / bar
            record[f"{model}_q_of_bar"] = of_bar
            if of_bar > 1:
                faults.append(f"a finer comparison differs by {of_bar:.2g} bars in the largest difference of Q")
        worst, name = largest_of_bar(own, fine)
        record[f"{model}_other_of_bar"], record[f"{model}_other"] = worst, name
        if worst > 1:
            faults.append(f"a finer comparison differs by {worst:.2g} bars in {name}")
    record["faults"] = "; ".join(faults)


def largest_of_bar(own, fine):
    """The largest error of a difference over the bars of both comparisons, and its name. Few bars are a fault as well."""
    found = []
    for name, difference in own["differences"].items():
        true = fine["differences"].get(name, {"uncertainty": None})
        if None in (difference["uncertainty"], true["uncertainty"]):
            continue
        error = max(abs(difference[of] - true[of]) for of in ("max", "rms"))
        found.append((error / max(difference["uncertainty"] + true["uncertainty"], ROUND_OFF), name))
    return max(found) if len(found) >= LEAST_BARS else (float("inf"), f"{len(found)} bars")


def run(program, seed, quick, with_continuum=True, **_):
    if not with_continuum:
        return []
    rng, records = random.Random(f"compared rows/{seed}"), []
    for _ in range(N_ROWS[quick]):
        family, n_rows = rng.choice(families())
        number = rng.randint(1, n_rows)
        record = {"kind": family, "number": number, "code": DONE, "faults": ""}
        judge_row(program, family, number, 4 + DEGREES_MORE[quick], record)
        records.append(record)
    for name in ("ratio_of_bar", "q_of_bar", "other_of_bar"):
        held = [record[f"{model}_{name}"] for record in records for model in MODELS if f"{model}_{name}" in record]
        print(f"compared rows: {len(held)} numbers are held against finer comparisons, the largest {name} is {max(held, default=0):.2g}")
    return records
