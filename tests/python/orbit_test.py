"""The movie of an orbit: its frames, the lag and the spin that it shows, refusals."""
import math

import numpy as np
import PIL.Image

from package_test import PackageTest
from program_test import main
from pseudorigid import WrongInput, gif
from pseudorigid.orbit import chosen_factor, chosen_model, chosen_samples, images
from pseudorigid.orbit_motion import read_motion

SCENE = {"Models": "reduced", "Gravity/Gamma": 1, "Material/Viscosity": 1, "Companions/Masses": 40, "Companions/Positions": "8, 0, 0", "Time/End": 20,
         "Output/Samples": 40, "Initial state/Velocity": "0, -0.3, 0; 0.3, 0, 0; 0, 0, 0"}
ECCENTRIC = {"Body/Semi-axes": "1.1, 1, 0.9", "Companions/Positions": "", "Companions/Semi-major axes": 10, "Companions/Eccentricities": 0.4,
             "Companions/Inclinations": 1}
TWO = {"Companions/Masses": "40; 5", "Companions/Positions": "8, 0, 0; 0, 50, 0"}
SI = {"Gravity/Gamma": 0, "Gravity/Constant": 6.674e-11, "Body/Radius": 250e3, "Body/Density": 1500, "Material/Shear modulus": 4e9,
      "Material/Viscosity": 1e14, "Companions/Masses": 5.683e26, "Companions/Positions": "1.6e8, 0, 0", "Time/End": 80000,
      "Initial state/Velocity": "0, 0, 0; 0, 0, 0; 0, 0, 0"}


class Orbit(PackageTest):
    SCENE = SCENE

    def test_frames(self):
        """Of an eccentric and inclined orbit, of two companions, and of a run in SI units: each frame differs and is not empty."""
        for changes in ECCENTRIC, TWO, SI:
            run = self.make_run(**changes)
            self.run_done("orbit", run.directory, "--frames", 5, "--start", 0, "--end", changes.get("Time/End", 20), "--width", 300)
            with PIL.Image.open(run.directory / "orbit.gif") as movie:
                self.assertEqual((movie.n_frames, movie.width), (5, 300))
                frames = []
                for frame in range(movie.n_frames):
                    movie.seek(frame)
                    frames.append(np.array(movie.convert("RGB")))
            for frame in frames:
                self.assertGreater(len(np.unique(frame.reshape(-1, 3), axis=0)), 20)
            for frame, following in zip(frames, frames[1:]):
                self.assertTrue((frame != following).any())

    def test_numbers(self):
        """Lag and spin are those of the tables, for an orbit in z = 0 that a spin along z leaves there."""
        run = self.make_run(**{"Models": "reduced, polynomial", "Polynomial/Degree": 1, "Continuum/Error estimate": "none"})
        for model in run.models:
            motion, columns = read_motion(run, model), run.columns(model)
            lags = [motion.lag(sample) for sample in range(1, 41)]
            np.testing.assert_allclose(lags, columns["lag"][1:], atol=1e-10)  # round-off over the size of the bulge
            np.testing.assert_array_equal(motion.spin, columns["spin3"])
            angles = np.unwrap(np.arctan2(columns["companion2"], columns["companion1"]))
            np.testing.assert_allclose(motion.orbits, angles / (2 * math.pi), atol=1e-3)  # the trapezoidal rule with 40 steps
            # The spin turns the marked radius. Its angle within the body oscillates by no more than twice the deformation.
            marks = np.array([motion.mark(sample, 1) for sample in range(41)])
            turned = np.unwrap(np.arctan2(*marks.T[::-1]))[-1]
            self.assertAlmostEqual(turned, np.trapz(columns["spin3"], columns["time"]), delta=2 * motion.deformation(np.arange(41)))

    def test_shapes(self):
        """The outline has the semi-axes of the projection, and its deformation is magnified about the mean radius at the start."""
        motion = read_motion(self.make_run(**ECCENTRIC), "reduced")
        for factor in 1, 3:
            least, largest = motion.mean_radius + factor * (motion.axes[0][7] - motion.mean_radius)
            distances = np.linalg.norm(motion.outline(7, factor), axis=1)
            np.testing.assert_allclose((distances.min(), distances.max()), (least, largest), rtol=1e-12)
            self.assertLess(np.linalg.norm(motion.mark(7, factor)), largest)
        # The marked radius points to the companion at the start.
        np.testing.assert_allclose(motion.mark(0, 1) / np.linalg.norm(motion.mark(0, 1)), motion.towards(1, 0), atol=1e-12)
        # A path of a Kepler orbit: the interpolated points keep the centre of mass, and go through the samples.
        paths = [motion.path(body, 0, 40) for body in (0, 1)]
        np.testing.assert_allclose(np.tensordot(motion.masses, paths, axes=1), 0, atol=1e-10 * motion.masses[1])
        np.testing.assert_array_equal(paths[1][::12], motion.positions[1])

    def test_choices(self):
        motion = read_motion(self.make_run(), "reduced")
        np.testing.assert_array_equal(chosen_samples(motion, 11, None, 20), np.arange(0, 41, 4))
        np.testing.assert_array_equal(chosen_samples(motion, 100, 5, 10), np.arange(10, 21))
        # The body turns by 0.15 between samples, so five of them are an eighth of a turn.
        np.testing.assert_array_equal(chosen_samples(motion, 3, None, None), [0, 5, 10])
        samples = np.arange(41)
        self.assertLessEqual(chosen_factor(motion, samples, None) * motion.deformation(samples), 0.35)  # the largest one that it draws
        self.assertEqual(chosen_factor(motion, samples, 2), 2)
        for wrong in -1, 0, float("nan"):
            with self.assertRaisesRegex(WrongInput, "--magnify"):
                chosen_factor(motion, samples, wrong)

    def test_refusals(self):
        run = self.make_run()
        for arguments, fragment in ((("nowhere",), "nowhere/manifest.json"), ((run.directory, "--frames", 2, "--output", "a.txt"), "--output")):
            self.assert_one_sentence(self.run_program("orbit", *arguments), fragment)
        motion = read_motion(run, "reduced")
        for choice in (1, None, None), (9, 30, None), (9, 5, 4):
            with self.assertRaisesRegex(WrongInput, "--frames"):
                chosen_samples(motion, *choice)
        with self.assertRaisesRegex(WrongInput, "--width"):
            images(run, "reduced", motion, np.arange(2), 1, 0)
        with self.assertRaisesRegex(WrongInput, "--model"):
            chosen_model(run, "continuum")
        (run.directory / "reduced.csv").unlink()
        with self.assertRaisesRegex(WrongInput, "motion"):
            chosen_model(run, None)
        alone = self.make_run(**{"Companions/Masses": "", "Companions/Positions": ""})
        self.assert_one_sentence(self.run_program("orbit", alone.directory), "companion")

    def test_a_gif_shows_its_frames(self):
        """Black, white and pixels that do not change, which frames leave out."""
        frames = []
        for step in range(3):
            pixels = np.full((20, 20, 3), 255, dtype=np.uint8)
            pixels[:5] = 0
            pixels[8:12, 5 * step : 5 * step + 5] = (0, 114, 178)
            frames.append(PIL.Image.fromarray(pixels))
        gif.write_gif(frames, 100, self.scratch / "squares.gif")
        with PIL.Image.open(self.scratch / "squares.gif") as movie:
            for step, frame in enumerate(frames):
                movie.seek(step)
                np.testing.assert_array_equal(np.array(movie.convert("RGB")), np.array(frame))


if __name__ == "__main__":
    main()
