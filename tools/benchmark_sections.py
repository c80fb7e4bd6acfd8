"""The sections of the page of benchmarks: what is computed, how the error is measured, how good the reference is; and
the sentences with numbers that other pages have too (None without data)."""

from benchmark_data import errors_of, front, read_notes, read_rows, read_runs, release_uncertainty, space_rate


def reference_of_release(data):
    uncertainty = release_uncertainty(data)
    return uncertainty and (f"The uncertainty of the reference is {uncertainty:.1e}: the largest difference between "
                            "the extrapolated values and those of the highest degree.")


def reference_of_lamb(_):
    # Of the series: benchmarks/lamb_response.cpp.
    return ("The uncertainty of the reference, relative to the largest response: the series is cut below 1e-8, and "
            "terms of order ε³, which the odd part keeps, are below 1e-7.")


def reference_of_frequency(_):
    # benchmarks/ball_frequency.cpp.
    return "The uncertainty of the reference is 2e-13 of it: the digits that are left out."


def rates_in_space(data):
    by_velocity = {(int(r["degree"]), int(r["refinements"])): float(r["error"])
                   for r in read_rows(data, "ball_release.csv")
                   if r["method"] == "symmetric-4" and float(r["tolerance"]) == 1e-5}
    from_stretch = {(int(r[f"{of}degree"]), int(r[f"{of}refinements"])): float(r[f"{of}error"])
                    for r in read_rows(data, "auto_discretization.csv") if r["scene"] == "release"
                    for of in ("", "hand_")}
    if min(len(by_velocity), len(from_stretch)) < 3:
        return None
    return ("The error in space falls as N⁻ᵖ with N = k·1.6^r for degree k and r refinements. "
            f"Least squares in logarithms give p = {space_rate(by_velocity):.1f} for this release by a velocity "
            f"(symmetric-4, {len(by_velocity)} discretisations), and p = {space_rate(from_stretch):.1f} for one from a "
            f"stretch (Q, {len(from_stretch)} discretisations of the part `auto`).")


def limits_of_the_machine(data):
    notes = [note for note in read_notes(data, "kernels.csv") if "triad" in note]
    return f"Measured limits of {notes[0]}." if notes else None


def drift_of_the_long_run(data):
    rows = read_rows(data, "long_run_summary.csv")
    ratios = [abs(float(r["energy_drift"]) / float(r["drift_error"])) for r in rows]
    return f"The largest drift is {max(ratios):.1f} times its standard error." if ratios else None


def dates(data):
    """Which parts were measured when and of which commit, and on what."""
    runs, groups = read_runs(data), {}
    for part, run in sorted(runs.items()):
        groups.setdefault((run["date"][:10], run["commit"][:9]), []).append(part)
    machines = {(run["processor"], run["cores"], run["vector instructions"], run["compiler"]) for run in runs.values()}
    lines = [f"- machine: {', '.join(machine)}" for machine in sorted(machines)]
    return "\n".join([*lines, *(f"- {date}, commit {commit}: {', '.join(parts)}" for (date, commit), parts in sorted(groups.items()))]) or None


def summary_picture(data):
    """The picture of README.md, described by the ends of its lines."""
    own, peers = front(errors_of(data, "ball_release.csv")), front(errors_of(data, "fenicsx_release.csv"))
    if not own or not peers:
        return None

    def fall(points):
        (first, large), (last, small) = points[0], points[-1]
        return f"from {large:.1e} at {first:.2g} s to {small:.1e} at {last:.2g} s"

    return ('<img src="docs/images/benchmark_summary.svg" width="430" alt="Error of Q33 against processor time after a '
            f'nonlinear release, the best runs of two programs: pseudorigid falls {fall(own)}, FEniCSx {fall(peers)}; '
            f'the uncertainty of the reference is {release_uncertainty(data):.1e}.">')


def small_systems():
    return [
        ("Pseudo-rigid ball", "small-systems",
         ["Neo-Hookean pseudo-rigid ball on SL(3), κ = 5, from Q = diag(1.3, 1, 1/1.3) with a full Q⁻¹Q̇, until "
          "t = 100, about 50 pulsations.",
          "Every method delivers 100 equidistant samples. Error: largest difference of any coordinate, positions and "
          "velocities, at any sample from a reference in quadruple precision (benchmarks/make_references.cpp: "
          "right-hand sides of its own, extrapolation at two step sizes, which agree to 1e-20). Time: processor time "
          "from the construction of the integrator to the last sample, median of five rounds through all methods, and "
          "of three such runs. "
          "Table: ms for an error, between measured points on straight lines in logarithms; – where a method does not "
          "get there."],
         lambda f, d, i: f.draw_methods(d, i, "sl3"), ["sl3"]),
        ("Rigid body", "small-systems",
         ["Free rigid body with the moments of inertia 1, 2, 2.5 from Ω = (0.4, 1, 0.6), until t = 100."],
         lambda f, d, i: f.draw_methods(d, i, "rigid_body"), ["rigid_body"]),
        ("Double pendulum", "small-systems",
         ["Masses, lengths and g are 1, at rest at θ = 0.6, φ = 0.8, until t = 100."],
         lambda f, d, i: f.draw_methods(d, i, "double_pendulum"), ["double_pendulum"]),
        ("Fluid ellipsoid", "small-systems",
         ["Dirichlet's fluid ellipsoid under its own gravity, from Q = diag(1.2, 1, 1/1.2) with a full Q⁻¹Q̇, time in "
          "1/√(πGρ), until t = 100."],
         lambda f, d, i: f.draw_methods(d, i, "gravitating"), ["gravitating"]),
        ("Small systems: the fastest", "small-systems",
         ["For an error the fastest of the own methods and of the libraries, double pendulum in either form. SciPy has "
          "right-hand sides in Python (part peers). Libraries with a Nyström method for forces that depend on the "
          "velocity are not in Debian 12, nor are heyoka and DifferentialEquations.jl. odeint's methods of Nyström's "
          "kind are for q̈ = f(q)."],
         None, ["small_systems"]),
        ("Single calls", "methods", ["Medians of Google Benchmark. latency: each call waits for the one before."],
         None, ["single_calls", "self_gravity"]),
    ]


def errors_of_the_ball(data):
    return [
        ("Elastic ball: nonlinear release", "release",
         ["Incompressible neo-Hookean ball, μ = ρ = r = 1, from rest shape with the velocity 0.3 (x, y, −2z), until "
          "t = 5, on one octant. Error: largest difference of the mass moment Q33 over 50 samples from a reference "
          "(benchmarks/ball_release.py says how it is made). Process: processor time of the process less that of a "
          "start beside it, median; mesh, set-up and output are contained. Motion: wall time of the one thread from the "
          "search for the step, which is contained, to the last sample. FEniCSx (benchmarks/peers): processor time from "
          "the first assembly to the last sample; start, mesh and compilation of forms are left out. Its "
          "step was found by hand. Its time over both of ours is that of times interpolated in logarithms on the fronts: the "
          "cheapest run below a threshold would give 16 at an error of 1.34e-4 and 85 at 1.0e-4.",
          reference_of_release(data), rates_in_space(data)],
         lambda f, d, i: f.draw_release(d, i), ["release", "release_runs", "peers"]),
        ("Elastic ball: three programs", "peers",
         ["The same release by pseudorigid, FEniCSx and GetFEM in one run on one machine. Motion of pseudorigid, and processor "
          "time of the others, interpolated in logarithms on the fronts. Last table: a step of symmetric-4 of pseudorigid, and a "
          "midpoint step of 0.0125 of the others with the factors of the tangent, or a preconditioner (saddle_point.py), made once. "
          "The reference of FEniCSx alone is extrapolated from its own runs (benchmarks/peers/release.py)."],
         lambda f, d, i: f.draw_three_programs(d, i), ["three_programs", "runs_of_getfem", "sizes_of_peers", "references_of_release"]),
        ("Elastic ball: method and implementation", "midpoint",
         ["The release by the implicit midpoint rule of FEniCSx inside pseudorigid (benchmarks/implicit_midpoint.cpp). Elements, steps, "
          "guesses and tolerances are the same. The mass is lumped, and the matrices are condensed to the unknowns between cells."],
         None, ["method_and_implementation", "runs_of_midpoint"]),
        ("Elastic ball on one and two ranks", "ranks",
         ["Wall time of a step, and of the factors or the preconditioner that FEniCSx makes once. The method is symmetric-4 in "
          "pseudorigid, and the midpoint rule with steps of 0.0125 in FEniCSx."],
         None, ["ranks_of_peers"]),
        ("Elastic ball: modes by two programs", "modes",
         ["The 12 lowest frequencies with all their modes. pseudorigid: processor time of the process less that of a start and of the "
          "start of its libraries. FEniCSx: from the first assembly to the eigenvalues, without sorting by kind and degree."],
         None, ["modes_of_peers"]),
        ("Elastic ball: nearly incompressible", "bulk",
         ["The release with λ from 10² to 10⁵ μ and both forms of Material/Bulk. Wall time of one thread from the search for the step to "
          "the last sample, interpolated in logarithms on the fronts (benchmarks/nearly_incompressible.py)."],
         None, ["nearly_incompressible"]),
        ("Elastic ball at rest in a trap", "figures",
         ["Figure of equilibrium of the neo-Hookean ball under the force −ρ T x, T = diag(0.6, 0.6, 0). pseudorigid: processor time of "
          "the process less that of a start. The last column also has the small motions about the "
          "figure, and both again on a companion mesh. FEniCSx and GetFEM: Newton's iteration with factors by MUMPS, from the first "
          "assembly to the last solution. Second table: GetFEM with the cheapest figure of pseudorigid that is at least as accurate."],
         None, ["static_figures", "static_figures_of_getfem"]),
        ("Ladder of models", "ladder",
         ["The same release by polynomial bodies of degree N and by finite elements of degree k, symmetric-4 with the "
          "tolerances 5e-3, 1e-3 and 1e-4. Time: processor time from the start of the process to its end, median; the search "
          "for the step is contained. Table: with 1e-4. N = 1 is the pseudo-rigid body."],
         lambda f, d, i: f.draw_ladder(d, i), ["ladder"]),
        ("Elastic ball: release under its own gravity", "gravity",
         ["The same with γ = ρgr/μ = 5, g = (4/3)πGρr; the reference likewise. Second table: a step of symmetric-4, and in it "
          "one evaluation of gravity, from the positions to the forces; then the sums over pairs alone, counted as 45 "
          "operations for each target and source. A distance serves both of "
          "its points and images share terms, so that fewer operations are made than are counted."],
         None, ["gravitating_release", "gravity_cost"]),
        ("Elastic ball: small affine release", "lamb",
         ["ẋ(0) = εHX with H = diag(1, 1, −2), ε = 1e-4, until t = 5, on one octant. Error: odd part in ε of Q − Id "
          "over ε against the exact response Σ f_k sin(x_k t)/x_k of the incompressible sphere (Lamb 1882), largest "
          "over 100 samples, relative to the largest response.", reference_of_lamb(data)],
         lambda f, d, i: f.draw_lamb(d, i), ["lamb"]),
        ("Elastic ball: lowest spheroidal frequency", "frequency",
         ["S2 of the incompressible sphere, 2.665622189236 c/r. octant: the lowest mode of the motion that is "
          "symmetric to three planes; all parities: as Analysis = modes finds it among all modes of the ball. From "
          "mesh to eigenvalue, after the start of the libraries, median.", reference_of_frequency(data)],
         lambda f, d, i: f.draw_frequency(d, i), ["frequency"]),
        ("Discretisation from a tolerance", "auto",
         ["Continuum/Degree = auto, Refinements = auto beside the cheapest discretisation that meets the tolerance, "
          "found by hand: scenes of tests/app/auto_degree_test.py, one octant, t ≤ 2, Time/Tolerance a twentieth of "
          "Continuum/Tolerance. Error: largest difference of an entry of Q from degree 6 refined once. s: wall "
          "time without loading the libraries, median of three to fifteen runs. work: unknowns × forces, pilots and "
          "search included."],
         None, ["auto_discretization"]),
    ]


def costs_of_the_ball(data):
    return [
        ("Cell kernels", "kernels",
         ["Octant refined to at least 100,000 unknowns, one core, medians of 25 rounds of all kernels in turn; the "
          "force agrees with that of dealii::FEEvaluation to 1e-12. FEEvaluation with one lane is that of Debian's deal.II, and "
          "with more lanes its headers compiled with our number of lanes. roofline: what counted flops and bytes would take "
          "at the machine's measured limits.", limits_of_the_machine(data)],
         lambda f, d, i: f.draw_kernels(d, i), ["kernels", "equal_width"]),
        ("Steps", "steps",
         ["Release with the velocity 0.3 (x, y, −2z) at 0.9 of the stability limit of RATTLE; medians. step/force: "
          "time of a step over that of one evaluation of the force. Last table: iterations of one solve with the Gram "
          "operator by two levels, until a random residual has fallen by 1e-4, at rest and far from it "
          "(tests/continuum/sheared.h)."],
         lambda f, d, i: f.draw_steps(d, i), ["steps", "ranks", "gram_iterations"]),
    ]


def sections(data):
    """[(title, part of scripts/benchmark.sh, paragraphs, figure, tables)]; paragraphs of parts without data are None"""
    return [
        *small_systems(), *errors_of_the_ball(data), *costs_of_the_ball(data),
        ("What scenes skip", "skipping",
         ["Every scene of params/ as it is and with one skipped part after the other asked for; processor time of the "
          "process, start included, medians of three. Scenes with finite elements are shortened to t ≤ 1. work: "
          "evaluations of forces, in the continuum times unknowns; it has no value where they are not what the part "
          "adds, and stands with the scenes where it is not the same. That results stay the same is tested by "
          "tests/app/skipping_test.py."],
         lambda f, d, i: f.draw_skipping(d, i), ["skipped_parts", "skipping"]),
        ("A million periods", "long-run",
         ["The pseudo-rigid ball and the rigid body of the first sections over 2·10⁶ units of time: largest relative "
          "errors at 1000 samples, drift of the energy with its standard error as that of a random walk, exponents of "
          "the time with which energy and coordinates grow. The motion of the ball is chaotic: its coordinates are "
          "lost. Dots are samples, lines the largest error in each twentieth of the time.",
          drift_of_the_long_run(data)],
         lambda f, d, i: f.draw_long_run(d, i), ["long_run"]),
    ]
