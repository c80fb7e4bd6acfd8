#!/usr/bin/python3
"""Complex Love numbers of viscoelastic balls in a slow periodic tide, compared with the theory (docs/viscoelasticity.md).

    benchmarks/rheology.py build/release/bin/pseudorigid [--quick] [--only MODEL] > rheology.csv

The tide -(1/2) x.T(t)x has the frequency w = 0.01 c/r. With gamma = rho g r/mu for the modulus mu = 1, with the gravity
g = (4 pi/3) rho G r and with the complex modulus mu*(w), the quadrupole of the ball is that of the strain

    e = -T/(0.8 gamma + 0.8 f mu*(w) - w^2),   k2 = -1.2 gamma e/T,

with f = 19/2 for an incompressible ball (Kelvin) and f = 25/2 for the pseudo-rigid one. The term w^2 of inertia is exact for
the pseudo-rigid ball and for a fluid. For an elastic ball it is exact up to its size, 1e-5 of k2.
The columns are the model, the rheology, gamma, w tau, the relative error of |k2|, the error of its phase in radians, |k2|, the
phase, and seconds. The response is fitted to the last periods, together with the decay of the start.
"""
import argparse
import cmath
import math
import pathlib
import sys
import tempfile
import time

import numpy as np

import program

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "tests/support"))
from program_test import scene_text  # noqa: E402

FREQUENCY, SIZE, RISE = 0.01, 1e-4, 300.0
MODELS = {"reduced": (12.5, {"Time/Step": 0.1}), "polynomial": (9.5, {"Polynomial/Degree": 3, "Time/Step": 0.1}),
          "continuum": (9.5, {"Continuum/Degree": 3, "Continuum/Error estimate": "none"})}  # with the largest stable step
# A body that is nearly fluid, with gamma > 100 |mu*|, needs more points of the surface for its gravity. The usual 7 points of
# N = 3 give the phase of the Maxwell body with gamma = 10 and w tau = 0.01 an error of 1e-3.
NEARLY_FLUID = {"polynomial": {"Polynomial/Gravity points": 10}, "continuum": {"Continuum/Gravity points": 8}}
# Values of gamma and of w tau. A run of finite elements takes minutes.
GRIDS = {"reduced": ((1, 10), (0.01, 0.1, 1, 10, 100)), "polynomial": ((1, 10), (0.01, 0.1, 1, 10, 100)), "continuum": ((1,), (1,))}
# Modulus of the law, viscosity over tau, and branches: modulus, time over tau.
RHEOLOGIES = {"Kelvin-Voigt": (1, 1, ()), "Maxwell": (0, 0, ((1, 1),)), "standard linear solid": (1, 0, ((0.5, 1),)),
              "Burgers": (0, 0, ((1, 1), (0.3, 5)))}


def modulus(rheology, s, tau):
    """mu* for motions exp(s t)."""
    law, viscosity, branches = RHEOLOGIES[rheology]
    return law + s * viscosity * tau + sum(mu * s * time * tau / (1 + s * time * tau) for mu, time in branches)


def decay_rates(rheology, tau, gamma, factor):
    """The zeros of gamma + f mu*(s): the rates at which the start decays without inertia."""
    law, viscosity, branches = RHEOLOGIES[rheology]
    numerator = np.poly1d([factor * viscosity * tau, gamma + factor * law])
    others = [np.poly1d([time * tau, 1]) for _, time in branches]
    for other in others:
        numerator *= other
    for b, (mu, time) in enumerate(branches):
        product = np.poly1d([factor * mu * time * tau, 0])
        for other in others[:b] + others[b + 1:]:
            product *= other
        numerator += product
    return np.real(numerator.roots)


def response(run, model, rheology, gamma, tau):
    """(k2, seconds)"""
    factor, entries = MODELS[model]
    law, viscosity, branches = RHEOLOGIES[rheology]
    period = 2 * math.pi / FREQUENCY
    material = {"Material/Viscosity": viscosity * tau} if law else {"Material/Law": "none"}
    if branches:
        material |= {"Material/Branch moduli": ", ".join(repr(mu) for mu, _ in branches),
                     "Material/Branch times": ", ".join(repr(time * tau) for _, time in branches)}
    if gamma > 100 * abs(modulus(rheology, 1j * FREQUENCY, tau)):
        entries = {**entries, **NEARLY_FLUID.get(model, {})}
    end = RISE + 3 * period
    start = time.perf_counter()
    table = run({"Time/Tolerance": 1e-6, **entries, **material, "Models": model, "Gravity/Constant": repr(3 * gamma / (4 * math.pi)), "Loads/Tidal frequency": FREQUENCY, "Loads/Rise time": RISE,
                 "Loads/Tidal amplitude": f"{SIZE}, 0, 0; 0, {-SIZE / 2}, 0; 0, 0, {-SIZE / 2}", "Time/Method": "rattle",
                 "Time/End": end, "Output/Samples": 20000, "Output/Report": "false"}).table(f"{model}.csv")
    seconds = time.perf_counter() - start
    t, strain = np.array(table["time"]), np.array(table["Q11"]) - 1
    late = t > RISE + period
    decays = [np.exp(rate * (t[late] - RISE)) for rate in decay_rates(rheology, tau, gamma, factor)]
    columns = np.stack([np.cos(FREQUENCY * t[late]), np.sin(FREQUENCY * t[late]), np.ones(late.sum()), *decays], axis=1)
    scales = np.abs(columns).max(axis=0)
    columns = columns[:, scales > 1e-10]
    c, s = np.linalg.lstsq(columns, strain[late], rcond=None)[0][:2]
    return -1.5 * complex(c, -s) / SIZE * 0.8 * gamma, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", choices=MODELS)
    options = parser.parse_args()
    print("model,rheology,gamma,omega_tau,error_of_size,error_of_phase,size,phase,seconds")
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.prm"
        scene.write_text(scene_text({}))
        for model in [options.only] if options.only else MODELS:
            for rheology in RHEOLOGIES:
                gammas, products = ((1,), (1,)) if options.quick else GRIDS[model]
                for gamma in gammas:
                    for omega_tau in products:
                        tau = omega_tau / FREQUENCY
                        k2, seconds = response(lambda entries: program.run(options.program, scene, pathlib.Path(folder) / "out", entries),
                                               model, rheology, gamma, tau)
                        exact = 1.2 * gamma / (0.8 * gamma + 0.8 * MODELS[model][0] * modulus(rheology, 1j * FREQUENCY, tau) - FREQUENCY**2)
                        print(model, rheology, gamma, omega_tau, f"{abs(k2 / exact) - 1:.2e}", f"{cmath.phase(k2 / exact):.2e}",
                              f"{abs(k2):.6g}", f"{cmath.phase(k2):.6g}", f"{seconds:.2f}", sep=",", flush=True)


if __name__ == "__main__":
    main()
