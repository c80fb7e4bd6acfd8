# A sweep of comparisons: how wrong the pseudo-rigid frequency is, over the amplitude, with error bars. As analyse_run.py.
#
#     PYTHONPATH=python /usr/bin/python3 python/examples/compared_sweep.py output/compared_amplitudes
#
# It needs pandas and matplotlib.

# %% The ball is stretched by exp(a) along z and released. Each row compares the pseudo-rigid model with finite elements.
import sys

import matplotlib.pyplot as plt

import pseudorigid
from pseudorigid.figures import STYLES

output = sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else "output/compared_amplitudes"
run = pseudorigid.run({
    "Models": "reduced, continuum",
    "Continuum/Degree": 3,
    "Sweep/Parameters": "a: 0.02, 0.05, 0.1, 0.15",
    "Initial state/Deformation": "$(exp(-a/2)), 0, 0; 0, $(exp(-a/2)), 0; 0, 0, $(exp(a))",
    "Time/End": 25,
    "Time/Tolerance": 1e-4,
    "Output/Samples": 250,
}, output=output)

# %% A row for each run. A ratio that a run does not have is nan.
sweep = run.sweep()
excess, bar = 100 * (sweep["reduced_frequency_ratio"] - 1), 100 * sweep["reduced_frequency_ratio_error"]
for a, e, b, phase in zip(sweep["a"], excess, bar, sweep["reduced_phase_after_10_periods"]):
    print(f"amplitude {a:g}: {e:.1f} +- {b:.1g} % too fast, after ten periods {phase:.2f} periods ahead")

# %% The picture. The dotted line is the exact value for small amplitudes.
figure, ax = plt.subplots(figsize=(5, 3.5), layout="constrained")
ax.errorbar(sweep["a"], excess, bar, fmt="o", capsize=4, color=STYLES["reduced"]["color"])
ax.axhline(18.6319, color="#777777", linestyle=":")
ax.set_xlabel("initial amplitude a (logarithm of the stretch)")
ax.set_ylabel("pseudo-rigid frequency too high by (%)")
picture = f"{output}/frequency_error.svg"
figure.savefig(picture)
print("the picture is", picture)
