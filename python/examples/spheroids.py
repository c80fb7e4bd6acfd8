# Figures of equilibrium: Maclaurin's spheroids of a fluid that turns rigidly, beside Maclaurin's formula. A notebook as a
# script, as analyse_run.py.
#
#     PYTHONPATH=python /usr/bin/python3 python/examples/spheroids.py output/spheroids
#
# It needs NumPy and matplotlib.

# %% A family of spheroids, by the eccentricity of the meridian. The entries make r = rho = pi G rho = 1.
import sys

import matplotlib.pyplot as plt
import numpy as np

import pseudorigid

output = sys.argv[1] if len(sys.argv) > 1 and "ipykernel" not in sys.modules else "output/spheroids"
scene = {"Models": "reduced", "Analysis": "equilibrium", "Material/Law": "none", "Gravity/Constant": "$(1/pi)",
         "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.1, "Equilibrium/Last": 0.99, "Equilibrium/Number": 90}
run = pseudorigid.run(scene, output=output)
family = run.records("equilibria")
family = family[family["kind"] == 0]  # without the special points of the family
print(len(family), "spheroids,", int(family["stable"].sum()), "of them stable")

# %% Maclaurin: Omega^2/(pi G rho) = 2 sqrt(1 - e^2) (3 - 2 e^2) asin(e)/e^3 - 6 (1 - e^2)/e^2.
e = family["parameter"]
exact = 2 * np.sqrt(1 - e**2) * (3 - 2 * e**2) * np.arcsin(e) / e**3 - 6 * (1 - e**2) / e**2
print(f"largest error of Omega^2: {np.abs(family['omega3']**2 - exact).max():.1e}")

# %% A mistake is an exception with the program's sentence.
try:
    pseudorigid.run(scene, {"Equilibrium/Family": "maclaurins"}, output=output)
except pseudorigid.WrongInput as error:
    print(error)

# %% The picture.
figure, ax = plt.subplots(figsize=(5, 3.5), layout="constrained")
stable = family["stable"] == 1
for chosen, style, label in ((stable, "-", "stable"), (~stable, ":", "a disturbance grows")):
    ax.plot(e[chosen], family["omega3"][chosen] ** 2, style, color="#0072B2", label=label)
ax.set_xlabel("eccentricity e of the meridian")
ax.set_ylabel(r"squared spin $\Omega^2/\pi G\rho$")
ax.legend(frameon=False)
figure.savefig(run.directory / "spheroids.svg")
