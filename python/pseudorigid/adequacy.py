"""The maps of docs/adequacy.md from the sweeps of params/adequacy. Needs Debian's python3-matplotlib.

    python3 -m pseudorigid adequacy output/adequacy --output docs/images --data docs/data/adequacy

reads output/adequacy/<family>/sweep.csv, draws the maps, and writes the columns behind them as CSV.

    python3 -m pseudorigid adequacy docs/data/adequacy --ranges

prints the ranges of the table of the page from these columns.
"""
import argparse
import csv
import math
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.figures import STYLES, plt, save

with needs("python3-numpy"):
    import numpy as np

Rows = dict[str, np.ndarray]
TITLES = {"reduced": "pseudo-rigid", "polynomial_3": "N = 3", "polynomial": "N = 5"}
STARTS = {0: "stretched", 1: "flattened", 2: "set in motion", 3: "pure shear", 4: "simple shear"}
LAWS = ("neo-hookean", "mooney-rivlin", "gent", "saint-venant-kirchhoff", "ciarlet-geymonat")
# Rows of the table of the page: family, parameter, its range, and the measure.
RANGES = (("amplitude", "a", 0, 0.11, "frequency_ratio"), ("amplitude", "a", 0.2, 0.3, "frequency_ratio"),
          ("compressibility", "a", 0, 0.01, "frequency_ratio"), ("compressibility", "a", 0.14, 0.16, "frequency_ratio"),
          ("gravity", "g", 0, 1.01, "frequency_ratio"), ("gravity", "g", 1.01, 18, "frequency_ratio"),
          ("gravity", "g", 18, 101, "frequency_ratio"), ("gravity", "g", 300, 1001, "frequency_ratio"),
          ("viscosity", "eta", 0, 0.03, "strain_difference_max"), ("viscosity", "eta", 1, 31, "strain_difference_max"),
          ("viscosity", "eta", 2, 31, "strain_difference_max"), ("tide", "f", 0, 2, "amplitude"), ("tide", "f", 2.4, 3.4, "amplitude"),
          ("tide", "f", 2.4, 3.4, "strain_difference_max"), ("shape", "p", 0, 3, "frequency_ratio"), ("spin", "w", 0, 1.01, "frequency_ratio"),
          *(("equilibria", "g", low, high, f"{measure}_ratio") for low, high in ((-1, 1.01), (9, 101), (101, 1001))
            for measure in ("bulge", "strain", "momentum")),
          *(("static_tide", "g", low, high, f"{measure}_ratio") for low, high in ((-1, 1.01), (9, 11), (99, 101), (999, 1001))
            for measure in ("bulge", "strain")),
          *(("stress", "s", 0.5, 1.5, f"{measure}_von_mises_ratio") for measure in ("mean", "max")),
          *((f"law-{law}", "l", low, high, "max_stretch_difference_max") for law in LAWS for low, high in ((1, 1.11), (1.69, 1.71))))
# Columns that the pages and the pictures use, after the parameters.
KEPT = ("compared", "_finished", "_amplitude", "_frequency_ratio", "_frequency_ratio_error", "_strain_difference_max",
        "_strain_difference_error", "_max_stretch_difference_max", "_max_stretch_difference_error", "_bulge_ratio", "_bulge_ratio_error",
        "_strain_ratio", "_strain_ratio_error", "_momentum_ratio", "_von_mises_ratio",
        "_von_mises_ratio_error", "_von_mises_difference_rms")


def read(folder: pathlib.Path, family: str) -> Rows:
    path = folder / family / "sweep.csv"
    if not path.is_file() and (folder / f"{family}.csv").is_file():
        path = folder / f"{family}.csv"
    if not path.is_file():
        raise WrongInput(f"{path} does not exist; run params/adequacy/{family.split('-')[0]}.prm first")
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    values = dict(zip(header, np.array(rows, dtype=float).T))
    return values if "compared" in values else compared_figures(values)


def compared_figures(rows: Rows) -> Rows:
    """The figures of every model of a sweep of equilibria as ratios to those of the finite elements: the bulge of the surface and the
    strain ln(a1/a3) of the nearest ellipsoid with their bars, and the angular momentum of figures that turn. If the sweep has no
    pseudo-rigid model, its place is taken by the polynomial body of degree 1."""
    done = rows["finished"] == 1
    parameters = list(rows)[:list(rows).index("finished")]
    result = {**{name: rows[name] for name in parameters}, "compared": rows["finished"]}

    def column(name: str) -> np.ndarray:
        return np.where(done, rows[name], np.nan)

    def measures(model: str) -> dict[str, np.ndarray]:
        if f"{model}_finished" not in rows:
            model = "polynomial_1"
        surface = "a" if model == "reduced" else "surface"
        values = {"bulge": column(f"{model}_{surface}1") - column(f"{model}_{surface}3"),
                  "strain": np.log(column(f"{model}_a1") / column(f"{model}_a3")), "momentum": column(f"{model}_J3")}
        return {name: value for name, value in values.items() if np.any(np.nan_to_num(value) != 0)}

    reference = measures("continuum")
    if "continuum_surface_error" not in rows:
        raise WrongInput("the sweep has no errors of the elements; use Continuum/Error estimate = auto")
    # Both axes may be wrong by their error, in opposite directions.
    errors = {"bulge": 2 * column("continuum_surface_error"),
              "strain": 2 * column("continuum_axes_error") / np.minimum(column("continuum_a1"), column("continuum_a3"))}
    for model in TITLES:
        for name, values in measures(model).items():
            ratio = values / reference[name]
            result[f"{model}_{name}_ratio"] = np.nan_to_num(ratio)
            if name in errors:
                result[f"{model}_{name}_ratio_error"] = np.nan_to_num(np.abs(ratio) * errors[name] / np.abs(reference[name]))
    return result


def known(rows: Rows, column: str) -> np.ndarray:
    """The values of a column; NaN if there is none."""
    return np.where((rows["compared"] == 1) & (rows[column] > 0), rows[column], np.nan)


def excess(rows: Rows, model: str) -> np.ndarray:
    """Relative error of a model's frequency."""
    return known(rows, f"{model}_frequency_ratio") - 1


def keep(rows: Rows, path: pathlib.Path) -> None:
    names = list(rows)
    parameters = names[:names.index("compared")]
    kept = parameters + [name for name in names if name not in parameters and name.endswith(KEPT)]
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(kept)
        for k in range(len(rows["run"])):
            writer.writerow(f"{rows[name][k]:.6g}" for name in kept)


def bars(rows: Rows, model: str, measure: str) -> np.ndarray:
    """The error bars of a measure of RANGES; negative or NaN if they are not known. An amplitude is √2 times the root mean square of
    C − mean of C. Let r be its ratio to that of the finite elements. An error d of C, relative to the larger amplitude, changes r by at
    most √2 max(1, r)² d."""
    name = f"{model}_strain_difference_error" if measure == "amplitude" else f"{model}_{measure.removesuffix('_max')}_error"
    known_bars = rows.get(name, np.full(len(rows["run"]), np.nan))
    if measure == "amplitude":
        ratio = rows[f"{model}_amplitude"] / rows["continuum_amplitude"]
        known_bars = math.sqrt(2) * np.maximum(1, ratio)**2 * known_bars
    return known_bars


def print_ranges(folder: pathlib.Path) -> None:
    """A line for each row of RANGES: the least and the greatest value for each model in per cent (of an amplitude its ratio to that of
    the finite elements), and the median and the largest of the error bars in per cent with the number of runs without a bar."""
    for family, parameter, low, high, measure in RANGES:
        rows = read(folder, family)
        inside = (rows[parameter] > low) & (rows[parameter] < high)
        parts = []
        for model in TITLES:
            if f"{model}_{measure}" not in rows:
                continue
            values = known(rows, f"{model}_{measure}")[inside]
            if measure.endswith("_ratio"):
                values = 100 * (values - 1)
            elif measure == "amplitude":
                values = values / rows["continuum_amplitude"][inside]
            else:
                values = 100 * values
            errors = 100 * bars(rows, model, measure)[inside & (rows["compared"] == 1)]
            errors, n_without = errors[errors >= 0], np.count_nonzero(~(errors >= 0))
            bar = f" (bars {np.median(errors):.2g}, up to {errors.max():.2g}, {n_without} without)" if errors.size else ""
            parts.append(f"{model} {np.nanmin(values):.3g} to {np.nanmax(values):.3g}{bar}")
        print(f"{family}, {parameter} = {low} to {high}, {measure}: {'; '.join(parts)}")


def print_ranges_of_impacts(path: pathlib.Path) -> None:
    """Prints the restitution and the largest force of impacts (docs/data/impacts.csv), compared with the first run of finite elements on
    the same plane."""
    with open(path, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["outcome"] == "done"]
    for low, high in (0, 0.3), (0.3, 3):
        inside = [row for row in rows if low < float(row["v"]) < high]
        elements: dict[tuple[str, str], dict[str, str]] = {}
        for row in inside:
            if row["model"] == "continuum":
                elements.setdefault((row["v"], row["stiffness"]), row)
        parts = []
        for model, degree in ("reduced", "1"), ("polynomial", "3"), ("polynomial", "5"):
            pairs = [(row, elements[row["v"], row["stiffness"]]) for row in inside if (row["model"], row["degree"]) == (model, degree)]
            more = [float(mine["e"]) - float(other["e"]) for mine, other in pairs]
            forces = [float(mine["force"]) / float(other["force"]) for mine, other in pairs]
            parts.append(f"N = {degree} e {min(more):+.3f} to {max(more):+.3f}, force {min(forces):.3g} to {max(forces):.3g} of the right one")
        print(f"impacts, v = {low} to {high} c: {'; '.join(parts)}")


def map_of_gravity(folder: pathlib.Path, output: pathlib.Path) -> None:
    """Frequency error over amplitude and self-gravity for N = 1, 3, 5."""
    rows = read(folder, "gravity")
    a, g = np.unique(rows["a"]), np.unique(rows["g"])
    figure, grid = plt.subplots(1, 3, figsize=(9.6, 3.6), sharey=True)
    figure.subplots_adjust(left=0.075, right=0.89, top=0.88, bottom=0.16, wspace=0.08)
    for axes, model in zip(grid, TITLES):
        error = 100 * np.abs(excess(rows, model)).reshape(len(a), len(g)).T
        bar = 100 * rows[f"{model}_frequency_ratio_error"].reshape(len(a), len(g)).T
        mesh = axes.pcolormesh(a, g, np.log10(np.maximum(error, 1e-3)), cmap="viridis", vmin=-3, vmax=1.5, shading="nearest")
        # Cells whose error is within the bar of the comparison.
        unresolved = np.argwhere(error <= bar)
        axes.plot(a[unresolved[:, 1]], g[unresolved[:, 0]], marker="x", color="white", linestyle="none", markersize=4)
        axes.set(xscale="log", yscale="log", title=TITLES[model], xlabel="amplitude a")
    grid[0].set_ylabel(r"self-gravity $\gamma = \rho g r/\mu$")
    scale = figure.colorbar(mesh, cax=figure.add_axes([0.905, 0.16, 0.018, 0.72]))
    scale.set_ticks([-3, -2, -1, 0, 1], labels=["0.001", "0.01", "0.1", "1", "10"])
    scale.set_label("frequency error, %")
    save(figure, output / "adequacy_map.svg")


def lines_over(axes: Any, rows: Rows, x: str, other: str, y: dict[str, np.ndarray], names: dict[str, str]) -> None:
    """A line for each model and each value of another parameter, the lighter the smaller it is."""
    others = np.unique(rows[other])
    for model, values in y.items():
        for k, value in enumerate(others):
            mine = rows[other] == value
            style = {**STYLES[model.split("_")[0]], "alpha": 0.35 + 0.65 * (k + 1) / len(others)}
            axes.plot(rows[x][mine], values[mine], label=names[model] if k + 1 == len(others) else None, **style)


def curves(folder: pathlib.Path, output: pathlib.Path) -> None:
    figure, grid = plt.subplots(2, 3, figsize=(10.8, 6.6))
    figure.subplots_adjust(left=0.065, right=0.985, top=0.94, bottom=0.085, wspace=0.3, hspace=0.36)
    names = {"reduced": "pseudo-rigid", "polynomial_3": "N = 3", "polynomial": "N = 3"}

    axes, rows = grid[0][0], read(folder, "amplitude")
    lines_over(axes, rows, "a", "s", {"reduced": 100 * np.abs(excess(rows, "reduced")),
                                      "polynomial_3": 100 * np.abs(excess(rows, "polynomial_3"))}, names)
    axes.axhline(18.6318, color="black", linewidth=0.8)
    axes.set(xscale="log", yscale="log", xlabel="amplitude a", ylabel="frequency error, %", title="amplitude, five kinds of start")

    axes, rows = grid[0][1], read(folder, "compressibility")
    lines_over(axes, rows, "l", "a", {m: 100 * np.abs(excess(rows, m)) for m in ("reduced", "polynomial")}, names)
    axes.set(xscale="log", yscale="log", xlabel=r"$\lambda/\mu$", ylabel="frequency error, %", title="compressibility")

    axes, rows = grid[0][2], read(folder, "viscosity")
    lines_over(axes, rows, "eta", "a", {m: 100 * known(rows, f"{m}_strain_difference_max") for m in ("reduced", "polynomial")}, names)
    axes.set(xscale="log", xlabel=r"$\eta c/(\mu r)$", ylabel="difference of C, % of its amplitude", title="viscosity")

    axes = grid[1][0]
    for law in LAWS:
        rows = read(folder, f"law-{law}")
        for model in ("reduced", "polynomial"):
            axes.plot(rows["l"], 100 * known(rows, f"{model}_max_stretch_difference_max"), **STYLES[model], alpha=0.7,
                      label=names[model] if law == LAWS[0] else None)
    axes.set(xlabel="stretch of the release", ylabel="error of the largest stretch, %", title="five laws")

    axes, rows = grid[1][1], read(folder, "shape")
    lines_over(axes, rows, "p", "a", {"reduced": 100 * np.abs(excess(rows, "reduced")),
                                      "polynomial_3": 100 * np.abs(excess(rows, "polynomial_3"))}, names)
    axes.set(xscale="log", yscale="log", xlabel="polar over equatorial axis", ylabel="frequency error, %", title="shape of the body")
    axes.set_xticks([0.4, 0.6, 1, 1.6, 2.5], labels=["0.4", "0.6", "1", "1.6", "2.5"])
    axes.minorticks_off()

    axes, rows = grid[1][2], read(folder, "tide")
    lines_over(axes, rows, "f", "eta", {m: rows[f"{m}_amplitude"] for m in ("reduced", "polynomial", "continuum")},
               {**names, "continuum": "finite elements"})
    axes.set(xlabel="angular frequency of the tide, c/r", ylabel="amplitude of C", title="periodic tide", yscale="log")
    for axes in grid.flat:
        axes.legend(fontsize=8, frameon=False)
    save(figure, output / "adequacy_curves.svg")


def figures_of_spin(folder: pathlib.Path, output: pathlib.Path) -> None:
    """Errors of the figure of a spinning ball over its spin, a line for each self-gravity and model."""
    rows = read(folder, "equilibria")
    figure, grid = plt.subplots(1, 3, figsize=(10.8, 3.6))
    figure.subplots_adjust(left=0.065, right=0.985, top=0.9, bottom=0.15, wspace=0.3)
    for axes, measure, title in zip(grid, ("bulge", "strain", "momentum"),
                                    ("equatorial bulge of the surface", r"mean strain $\ln(a_1/a_3)$", "angular momentum")):
        lines_over(axes, rows, "s", "g", {m: 100 * np.abs(known(rows, f"{m}_{measure}_ratio") - 1) for m in ("reduced", "polynomial_3")}, TITLES)
        axes.set(yscale="log", xlabel="spin s, fifths of the pulsation", ylabel="error, %", title=title)
        axes.legend(fontsize=8, frameon=False)
    for gamma in np.unique(rows["g"]):  # exact for a slow spin: the ratio of the Love numbers h2 of ellipsoid and sphere
        grid[0].axhline(100 * 3 / (12.5 + gamma), color="black", linewidth=0.5, linestyle=":")
    save(figure, output / "adequacy_figures.svg")


def figures_of_tide(folder: pathlib.Path, output: pathlib.Path) -> None:
    """Errors of the figure at rest under a constant tide over its strength, a line for each self-gravity and model."""
    rows = read(folder, "static_tide")
    figure, grid = plt.subplots(1, 2, figsize=(7.4, 3.6), sharey=True)
    figure.subplots_adjust(left=0.1, right=0.985, top=0.9, bottom=0.15, wspace=0.08)
    for axes, measure, title in zip(grid, ("bulge", "strain"), ("bulge of the surface", r"mean strain $\ln(a_1/a_3)$")):
        lines_over(axes, rows, "s", "g", {m: 100 * np.abs(known(rows, f"{m}_{measure}_ratio") - 1) for m in ("reduced", "polynomial_3")}, TITLES)
        axes.set(yscale="log", xlabel="strength s of the tide", title=title)
        axes.legend(fontsize=8, frameon=False)
    grid[0].set_ylabel("error, %")
    for gamma in np.unique(rows["g"]):  # exact for a weak tide: the ratio of the Love numbers h2 of ellipsoid and sphere
        grid[0].axhline(100 * 3 / (12.5 + gamma), color="black", linewidth=0.5, linestyle=":")
    save(figure, output / "adequacy_tides.svg")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("sweeps", type=pathlib.Path, help="folder with a folder for each family")
    parser.add_argument("--output", type=pathlib.Path, help="folder of the pictures")
    parser.add_argument("--ranges", action="store_true", help="print the ranges of the table of the page")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the columns behind them")


def main(options: argparse.Namespace) -> None:
    if options.ranges:
        print_ranges(options.sweeps)
        if (impacts := options.sweeps.parent / "impacts.csv").is_file():
            print_ranges_of_impacts(impacts)
    if options.output:
        map_of_gravity(options.sweeps, options.output)
        curves(options.sweeps, options.output)
        figures_of_spin(options.sweeps, options.output)
        figures_of_tide(options.sweeps, options.output)
    if options.data:
        for folder in sorted(options.sweeps.iterdir()):
            if (folder / "sweep.csv").is_file():
                keep(read(options.sweeps, folder.name), options.data / f"{folder.name}.csv")
