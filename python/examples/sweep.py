# A sweep: how the frequency of the pseudo-rigid ball falls with its amplitude. A notebook as a script, as analyse_run.py.
#
#     PYTHONPATH=python /usr/bin/python3 python/examples/sweep.py output/amplitudes
#
# It needs pandas and matplotlib. The scene is written here, entry by entry; docs/parameters.md lists the entries.

# %% The ball is stretched by l along z and released, for eight values of l.
import sys

import matplotlib.pyplot as plt
import numpy as np

import pseudorigid
from pseudorigid.figures import STYLES

output = sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else "output/amplitudes"
run = pseudorigid.run({
    "Models": "reduced",
    "Sweep/Parameters": "l: 1.02 .. 1.16 in 8",
    "Initial state/Deformation": "$(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)",
    "Time/End": 120,
    "Time/Tolerance": 1e-9,
    "Output/Samples": 1200,
    "Output/Quantities": "state",
}, output=output)

# %% A row for each run, with units.
sweep = run.sweep()
print(sweep[["l", "frequency", "amplitude", "Q33_min"]].round(4))
print("unit of the frequency:", run.unit("sweep", "frequency"))

# %% omega = sqrt(10) (1 + c A^2 + d A^4) c/r, where A is the amplitude of ln l. Theory has c = -5/48 = -0.1042.
A = np.log(sweep["Q33_max"] / sweep["Q33_min"]) / 2
d, c = np.polyfit(A**2, (sweep["frequency"] / np.sqrt(10) - 1) / A**2, 1)
print(f"c = {c:.4f}")

# %% The picture.
figure, ax = plt.subplots(figsize=(5, 3.5), layout="constrained")
ax.plot(sweep["l"], sweep["frequency"], "o-", color=STYLES["reduced"]["color"])
ax.axhline(np.sqrt(10), color="#777777", linestyle=":")
ax.set_xlabel("stretch l along z at the release")
ax.set_ylabel("frequency of C (c/r)")
figure.savefig(run.directory / "frequency.svg")
