# A notebook as a script: every `# %%` begins a cell for Jupyter (by jupytext), VS Code or Spyder; as a whole it runs with
#
#     python3 docs/analyse_run.py output/quickstart
#
# after `scripts/run.sh params/quickstart.prm`. It needs pandas, matplotlib and meshio (Debian: python3-pandas,
# python3-matplotlib, python3-meshio). docs/python.md has what it prints and draws.

# %% The module of the tools; from elsewhere put the folder `tools` of pseudorigid on the path.
import pathlib
import sys

import matplotlib

if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools") if "__file__" in globals() else "tools")
from run_directory import Run

directory = sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else "output/quickstart"
run = Run(directory)
print(run.models, run.entry("Body/Radius"), run.entry("Time/End"))

# %% Tables of pandas, the time as index.
reduced, continuum = run.table("reduced"), run.table("continuum")
print(reduced[["a1", "a2", "a3", "energy"]].describe().loc[["min", "max"]])

# %% What should be conserved, of both models.
for model in run.models:
    table = run.table(model)
    drift = (table["energy"] - table["energy"].iloc[0]).abs().max() / (table["kinetic"] + table["elastic"]).max()
    print(f"{model}: energy drifts by {drift:.1e} of the largest kinetic + elastic energy")

# %% Matrices: C = Q^T Q does not see rotations. The strain of both models, and where they are apart.
strains = {}
for model in run.models:
    Q = run.matrices(model, "Q")
    strains[model] = np.einsum("nki,nkj->nij", Q, Q)
apart = np.linalg.norm(strains["continuum"] - strains["reduced"], axis=(1, 2))
print(f"C differs most at t = {reduced.index[apart.argmax()]:.4g}, by {apart.max():.3g}")

# %% The comparison that the program made.
print(run.comparison["summary"])
frequency = run.comparison["frequency"]
if frequency["ratio_uncertainty"]:  # none if an error is not known, or if the balls follow a load
    print(f"ratio of the frequencies {frequency['ratio']:.4f} +- {frequency['ratio_uncertainty']:.1g}")

# %% A phase portrait of both models: the strain and its rate.
figure, ax = plt.subplots(figsize=(5, 4), layout="constrained")
for model, style in zip(run.models, ("--", "-")):
    C33 = strains[model][:, 2, 2]
    ax.plot(C33, np.gradient(C33, run.columns(model)["time"]), style, label=run.title(model))
ax.set_xlabel("C33")
ax.set_ylabel("dC33/dt")
ax.legend(frameon=False)
figure.savefig(pathlib.Path(directory) / "phase_portrait.png", dpi=120)

# %% Pictures: fields at the points of the elastic ball in the last frame, and its largest stress.
if run.has_frames("continuum"):
    frame = run.frames("continuum")[-1]
    picture = frame.read()
    stress = picture.fields["von_mises"]
    place = picture.points[stress.argmax()]
    print(f"t = {frame.time:g}: {len(picture.points)} points; von Mises stress up to {stress.max():.3g}, at {place.round(3)}")
