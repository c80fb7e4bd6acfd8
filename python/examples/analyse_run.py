# A notebook as a script: every `# %%` begins a cell for Jupyter (by jupytext), VS Code or Spyder. After
# `scripts/run.sh params/quickstart.prm` it runs as a whole:
#
#     PYTHONPATH=python /usr/bin/python3 python/examples/analyse_run.py output/quickstart
#
# It needs pandas, matplotlib and meshio (Debian: python3-pandas, python3-matplotlib, python3-meshio). docs/python.md has
# what it prints and draws.

# %% A run of two models.
import sys

import matplotlib.pyplot as plt
import numpy as np

from pseudorigid import Run, printed_error
from pseudorigid.figures import STYLES

run = Run(sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else "output/quickstart")
print(run.models, run.entry("Body/Radius"), run.entry("Time/End"))

# %% Tables of pandas, the time as index.
reduced, continuum = run.table("reduced"), run.table("continuum")
print(reduced[["a1", "a2", "a3", "energy"]].describe().loc[["min", "max"]])

# %% Of both models: the drift of the energy, which is conserved.
for model in run.models:
    table = run.table(model)
    drift = (table["energy"] - table["energy"].iloc[0]).abs().max() / (table["kinetic"] + table["elastic"]).max()
    print(f"{model}: energy drifts by {drift:.1e} of the largest kinetic + elastic energy")

# %% Matrices: the right Cauchy-Green tensor C = Q^T Q, which does not see rotations, and the largest difference of the models.
C = {model: np.einsum("nki,nkj->nij", run.matrices(model, "Q"), run.matrices(model, "Q")) for model in run.models}
apart = np.linalg.norm(C["continuum"] - C["reduced"], axis=(1, 2))
print(f"C differs most at t = {reduced.index[apart.argmax()]:.4g}, by {apart.max():.3g}")

# %% The comparison that the program made.
print(run.comparison["summary"])
frequency = run.comparison["frequency"]
if frequency["ratio_uncertainty"]:  # none if an error is not known, or if the balls follow a load
    print(f"ratio of the frequencies {frequency['ratio']:.4f} +- {printed_error(frequency['ratio_uncertainty'])}")

# %% A phase portrait of both models: C33, the squared stretch along z, and its rate.
figure, ax = plt.subplots(figsize=(5, 4), layout="constrained")
for model in reversed(run.models):
    C33 = C[model][:, 2, 2]
    ax.plot(C33, np.gradient(C33, run.columns(model)["time"]), **STYLES[model], label=run.title(model))
ax.set_xlabel("C$_{33}$ (squared stretch along z)")
ax.set_ylabel("dC$_{33}$/dt (c/r)")
ax.legend(frameon=False)
figure.savefig(run.directory / "phase_portrait.svg")

# %% Pictures: fields at the points of the elastic ball in the last frame, and its largest stress.
if run.has_frames("continuum"):
    frame = run.frames("continuum")[-1]
    picture = frame.read()
    stress = picture.fields["von_mises"]
    place = picture.points[stress.argmax()]
    print(f"t = {frame.time:g}: {len(picture.points)} points; von Mises stress up to {stress.max():.3g}, at {place.round(3)}")
