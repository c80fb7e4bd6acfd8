"""The sections of the page of benchmarks: what is computed, how the error is measured, how good the reference is."""

import benchmark_tables as tables


def sections(data):
    """[(title, part of scripts/benchmark.sh, paragraphs, figure, tables)]"""
    methods = ("Every method delivers 100 equidistant samples. Error: largest difference of any coordinate, positions and "
               "velocities, at any sample from a reference in quadruple precision (benchmarks/make_references.cpp: right-hand "
               "sides of its own, extrapolation at two step sizes, which agree to 1e-20). Time: processor time from the "
               "construction of the integrator to the last sample, median of the rounds through all methods. Table: ms for an "
               "error, between measured points on straight lines in logarithms; – where a method does not get there.")
    return [
        ("Pseudo-rigid ball", "methods",
         ["Neo-Hookean pseudo-rigid ball on SL(3), κ = 5, from Q = diag(1.3, 1, 1/1.3) with a full Q⁻¹Q̇, until t = 100, about "
          "50 pulsations.", methods],
         lambda f, d, i: f.draw_methods(d, i, "sl3"), ["sl3"]),
        ("Rigid body", "methods", ["Free rigid body with the moments of inertia 1, 2, 2.5 from Ω = (0.4, 1, 0.6), until t = 100."],
         lambda f, d, i: f.draw_methods(d, i, "rigid_body"), ["rigid_body"]),
        ("Double pendulum", "methods", ["Masses, lengths and g are 1, at rest at θ = 0.6, φ = 0.8, until t = 100."],
         lambda f, d, i: f.draw_methods(d, i, "double_pendulum"), ["double_pendulum"]),
        ("Single calls", "methods", ["Medians of Google Benchmark. latency: each call waits for the one before."],
         None, ["single_calls", "self_gravity"]),
        ("Elastic ball: nonlinear release", "release",
         ["Incompressible neo-Hookean ball, μ = ρ = r = 1, from rest shape with the velocity 0.3 (x, y, −2z), until t = 5, on "
          "one octant. Error: largest difference of the mass moment Q33 over 50 samples from a reference whose own uncertainty "
          f"is {tables.uncertainty_of_release(data)} (benchmarks/ball_release.py says how it is made). Time: processor time "
          "of the process less that of its start, median; the search for the step is contained. FEniCSx: benchmarks/peers, "
          "processor time from the first assembly to the last sample; start, mesh and compilation of forms left out."],
         lambda f, d, i: f.draw_release(d, i), ["release", "release_runs", "peers"]),
        ("Elastic ball: small affine release", "lamb",
         ["ẋ(0) = εHX with H = diag(1, 1, −2), ε = 1e-4, until t = 5, on one octant. Error: odd part in ε of Q − Id over ε "
          "against the exact response Σ f_k sin(x_k t)/x_k of the incompressible sphere (Lamb 1882), largest over 100 samples, "
          "relative to the largest response. The exact series is cut below 1e-8, cubic terms in ε are below 1e-7."],
         lambda f, d, i: f.draw_lamb(d, i), ["lamb"]),
        ("Elastic ball: lowest spheroidal frequency", "frequency",
         ["S2 of the incompressible sphere, 2.665622189236 c/r (its error is below 2e-13 of it). octant: the lowest mode of "
          "the motion that is symmetric to three planes; all parities: as Analysis = modes finds it among all modes of the "
          "ball. From mesh to eigenvalue, after the start of PETSc and SLEPc, median."],
         lambda f, d, i: f.draw_frequency(d, i), ["frequency"]),
        ("Cell kernels", "kernels",
         ["Octant refined to at least 100,000 unknowns, one core, medians of 25 rounds of all kernels in turn; the force "
          "agrees with that of dealii::FEEvaluation to 1e-12. roofline: what counted flops and bytes would take at the "
          "machine's measured limits."],
         lambda f, d, i: f.draw_kernels(d, i), ["kernels"]),
        ("Steps", "steps",
         ["Release with the velocity 0.3 (x, y, −2z) at 0.9 of the stability limit of RATTLE; medians. step/force: time of a "
          "step over that of one evaluation of the force. Last table: iterations of one solve with the Gram operator by two "
          "levels, until a random residual has fallen by 1e-4, at rest and far from it (tests/continuum/sheared.h)."],
         lambda f, d, i: f.draw_steps(d, i), ["steps", "ranks", "gram_iterations"]),
        ("What scenes skip", "skipping",
         ["Every scene of params/ as it is and with one skipped part after the other asked for; processor time of the "
          "process, start included, medians of three. Scenes with finite elements are shortened to t ≤ 1. That results stay "
          "the same is tested by tests/app/skipping_test.py."],
         lambda f, d, i: f.draw_skipping(d, i), ["skipped_parts", "skipping"]),
        ("A million periods", "long-run",
         ["The pseudo-rigid ball of the first section over 2·10⁶ units of time: largest relative errors at 1000 samples, drift "
          "of the energy with its standard error as that of a random walk."],
         lambda f, d, i: f.draw_long_run(d, i), ["long_run"]),
    ]
