"""The implicit midpoint rule for the nonlinear release of the ball, shared by the scripts of other programs.

  (2ρ/h²)(u¹ − u⁰ − h v⁰) = div(P(Fᵐ) + p Fᵐ⁻ᵀ),  Fᵐ = Id + ∇(u⁰ + u¹)/2,  ln det F(u¹) = 0,  v¹ = 2(u¹ − u⁰)/h − v⁰

with ρ = μ = 1, W = (μ/2)(tr C − 3 − 2 ln J) and the constraint at the end of the step; or five such steps, composed to order 4
(Suzuki). Modified Newton iterations keep their factors until an iteration converges slowly. They start from guesses that are
extrapolated from the last four steps.

A program gives a ball for a degree, refinements and, for sizes, the name of a solver. The ball has: velocity (at the start),
is_displacement (of each unknown), moment (Q33 = 1 + moment · u), begin(u⁰, u⁰ + h v⁰, h), residual(z), factors(z) (the function
that solves with them).
"""
import pathlib
import statistics
import sys
import time

import numpy as np

REFERENCE = pathlib.Path(__file__).resolve().parents[1] / "references/ball_release.csv"
END, SAMPLES = 5.0, 50
SUZUKI = (1 / (4 - 4 ** (1 / 3)),) * 2 + (1 - 4 / (4 - 4 ** (1 / 3)),) + (1 / (4 - 4 ** (1 / 3)),) * 2
SCHEMES = {"midpoint": (1.0,), "midpoint, order 4": SUZUKI}
# An iteration ends when no displacement changes by more. On unrefined meshes the errors of FEniCSx are the same with 1e-9. On refined
# meshes both are tried, and the reference has the last one.
TOLERANCES, TOLERANCES_OF_REFINED = (1e-7,), (1e-7, 1e-9)
STEP_OF_SIZES = 0.0125
SLOW = 0.5  # an iteration that reduces the change by less is with factors that are too old; 0.15 costs FEniCSx twice as much
CUBIC = {0: [], 1: [1], 2: [-1, 2], 3: [1, -3, 3], 4: [-1, 4, -6, 4]}  # extrapolations from so many values


class NoConvergence(Exception):
    """Newton's iteration of a step does not converge."""


class Motion:
    def __init__(self, ball, tolerance=TOLERANCES[0]):
        self.ball, self.tolerance = ball, tolerance
        self.u, self.v = np.zeros_like(ball.velocity), ball.velocity.copy()
        self.factors, self.past = {}, {}
        self.n_iterations = self.n_factorizations = self.n_steps = 0

    def change(self, dz):
        """The largest change of a displacement in one iteration."""
        return np.abs(dz[self.ball.is_displacement]).max()

    def step(self, h, place):
        """`place` is that of the step in the composition. Its guesses come from steps at the same place."""
        ball, is_u = self.ball, self.ball.is_displacement
        moved = self.u + h * self.v
        ball.begin(self.u, moved, h)
        past = self.past.get(place, [])
        z = sum((w * y for w, y in zip(CUBIC[len(past)], past)), np.where(is_u, moved, 0))
        before = np.inf
        for _ in range(30):
            if h not in self.factors:
                self.factors[h], before = ball.factors(z), np.inf
                self.n_factorizations += 1
            dz = self.factors[h](ball.residual(z))
            z = z - dz
            self.n_iterations += 1
            change = self.change(dz)
            if change < self.tolerance:
                break
            if change > SLOW * before:
                del self.factors[h]
            before = change
        else:
            raise NoConvergence(f"no convergence with step {h:.3g}")
        self.n_steps += 1
        self.past[place] = [*past[-3:], z - np.where(is_u, moved, 0)]
        self.v = np.where(is_u, 2 * (z - self.u) / h - self.v, 0)
        self.u, self.z = np.where(is_u, z, 0), z

    def run(self, weights, n_steps):
        Q33, h = [1.0], END / SAMPLES / n_steps
        for _ in range(SAMPLES):
            for _ in range(n_steps):
                for place, weight in enumerate(weights):
                    self.step(weight * h, place)
            Q33.append(1 + self.ball.moment @ self.u)
        return Q33


def main(make_ball, jobs, quick_jobs, sizes, documentation, of_reference=()):
    """`jobs` are {(degree, refinements): {scheme: steps between two samples}}, `sizes` {solver: ((degree, refinements), …)}, and
    `of_reference` three (degree, refinements) whose runs are extrapolated."""
    arguments = sys.argv[1:]
    if arguments in ([], ["--quick"]):
        measure_errors(make_ball, quick_jobs if arguments else jobs, bool(arguments))
    elif arguments == ["--sizes"]:
        measure_sizes(make_ball, sizes)
    elif len(arguments) == 2 and arguments[0] == "--reference" and of_reference:
        runs = measure_errors(make_ball, jobs, False)
        write_reference(pathlib.Path(arguments[1]), [runs[mesh] for mesh in of_reference], of_reference)
    else:
        raise SystemExit(documentation)


def write_reference(path, runs, meshes):
    """Writes Q33 of the last mesh, extrapolated in step and degree. `runs` have {steps between two samples: Q33} for each mesh, of
    the composition of order 4. In step the error falls as h⁴. In degree, the differences of the three meshes (root mean squares)
    fall by a factor ρ, and the last difference over ρ − 1 is left. The bar is the sum of the largest corrections in step and in degree."""
    def norm(values):
        return np.sqrt(np.mean(values**2))

    extrapolated, in_step = [], 0
    for of_steps in runs:
        coarse, fine = sorted(of_steps)[-2:]
        correction = (np.array(of_steps[fine]) - of_steps[coarse]) / ((fine / coarse) ** 4 - 1)
        in_step = np.abs(correction).max()
        extrapolated.append(of_steps[fine] + correction)
    first, second, third = extrapolated
    rho = norm(second - first) / norm(third - second)
    in_degree = (third - second) / (rho - 1)
    with open(path, "w") as file:
        of_meshes = ", ".join(f"degree {degree} refined {refinements}" for degree, refinements in meshes)
        print(f"# {of_meshes}, extrapolated; uncertainty {in_step + np.abs(in_degree).max():.1e}", file=file)
        print("time,Q33", file=file)
        for i, value in enumerate(third + in_degree):
            print(f"{i * END / SAMPLES:g},{value:.12f}", file=file)


def measure_sizes(make_ball, sizes):
    """Prints the processor time of `time_of_steps`. A row whose steps made factors again is left out."""
    print("degree,refinements,unknowns,solver,seconds_factors,seconds_step,iterations_per_step", flush=True)
    for solver, meshes in sizes.items():
        for degree, refinements in meshes:
            ball = make_ball(degree, refinements, solver)
            if measured := time_of_steps(Motion(ball), time.process_time):
                seconds_factors, seconds_step, n_iterations = measured
                print(degree, refinements, len(ball.velocity), solver, f"{seconds_factors:.4g}", f"{seconds_step:.4g}",
                      f"{n_iterations:.1f}", sep=",", flush=True)


def time_of_steps(motion, clock):
    """(seconds of the assembly of the tangent and of its factors or preconditioner, seconds of a step, its iterations). The step is
    the mean of three midpoint steps of 0.0125 after four others. None if one of the three made factors again."""
    n_steps, h = 3, STEP_OF_SIZES
    ball, make, seconds_factors = motion.ball, motion.ball.factors, []

    def timed_factors(z):
        start = clock()
        made = make(z)
        seconds_factors.append(clock() - start)
        return made

    ball.factors = timed_factors
    for _ in range(4):
        motion.step(h, 0)
    n_made, n_iterations, start = len(seconds_factors), motion.n_iterations, clock()
    for _ in range(n_steps):
        motion.step(h, 0)
    seconds = clock() - start
    ball.factors = make
    if len(seconds_factors) > n_made:
        return None
    return seconds_factors[-1], seconds / n_steps, (motion.n_iterations - n_iterations) / n_steps


def measure_errors(make_ball, jobs, quick):
    """Prints a row for each job and tolerance; of the short form, in one round. A job without convergence has none. Returns
    {(degree, refinements): {steps between two samples: Q33}} of the last scheme and tolerance of each mesh."""
    runs = {}
    print("degree,refinements,scheme,step,unknowns,seconds,error,iterations_per_step,factorizations,tolerance")
    exact = [float(line.split(",")[1]) for line in REFERENCE.read_text().splitlines()[2:]]
    for (degree, refinements), schemes in jobs.items():
        ball = make_ball(degree, refinements)
        Motion(ball).step(1e-3, 0)  # whatever is done once
        for scheme, steps in schemes.items():
            of_steps = runs[degree, refinements] = {}
            for n_steps in steps:
                for tolerance in TOLERANCES_OF_REFINED if refinements else TOLERANCES:
                    try:
                        seconds, motion, Q33 = repeated_run(ball, tolerance, SCHEMES[scheme], n_steps, 1 if quick else 3)
                    except NoConvergence as reason:
                        print(f"degree {degree} refined {refinements}, {scheme}, {n_steps} steps: {reason}", file=sys.stderr)
                        continue
                    of_steps[n_steps] = Q33
                    error = max(abs(a - b) for a, b in zip(Q33, exact))
                    print(degree, refinements, f'"{scheme}"', f"{END / SAMPLES / n_steps:.4g}", len(ball.velocity),
                          f"{seconds:.4g}", f"{error:.3g}", f"{motion.n_iterations / motion.n_steps:.1f}",
                          motion.n_factorizations, tolerance, sep=",", flush=True)
    return runs


def repeated_run(ball, tolerance, weights, n_steps, n_rounds):
    """(median of the seconds of some rounds, the last motion, its Q33)"""
    seconds = []
    while len(seconds) < n_rounds and sum(seconds) < 10:
        motion = Motion(ball, tolerance)
        start = time.process_time()
        Q33 = motion.run(weights, n_steps)
        seconds.append(time.process_time() - start)
    return statistics.median(seconds), motion, Q33
