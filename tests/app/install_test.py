"""`cmake --install` into an empty directory: what is there runs from anywhere, says what the program says, and goes away
again. One test, since there is one list of installed files in a build directory."""
import json
import os
import pathlib
import re
import subprocess
import sys

from program_test import ProgramTest, SOURCE, main


class Installation(ProgramTest):
    def setUp(self):
        super().setUp()
        self.build = self.program.parents[1]
        self.prefix = self.scratch / "prefix"
        self.home = self.scratch / "home"
        self.home.mkdir()

    def shell(self, *command, **options):
        return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True,
                              cwd=self.home, **options).stdout

    def test_what_is_installed_works_and_can_be_removed(self):
        # A build of the program alone has no manual page: it comes with the installation.
        (self.build / "pseudorigid.1").unlink(missing_ok=True)
        self.shell("cmake", "--install", self.build, "--prefix", self.prefix)
        self.program = self.prefix / "bin" / "pseudorigid"
        self.shares = self.prefix / "share"
        self.check_scenes()
        self.check_manual()
        self.check_completion()
        self.check_pages()
        self.check_python()
        self.check_library()
        self.shell("cmake", "-P", self.build / "uninstall.cmake")
        left = [path for path in self.files("prefix") if (self.prefix / path).is_file() or "pseudorigid" in path]
        self.assertEqual(left, [])

    def check_scenes(self):
        scenes = self.shares / "pseudorigid" / "params"
        self.assertEqual({path.name for path in scenes.iterdir()}, {path.name for path in (SOURCE / "params").iterdir()})
        self.assertIn(str(scenes), self.run_done("--help").stdout)
        # Both models: the program finds the library of the finite elements from where it stands.
        self.run_done("run", scenes / "quickstart.prm", "--set", "Time/End=0.5", cwd=self.home)
        manifest = json.loads((self.home / "output" / "quickstart" / "manifest.json").read_text())
        self.assertEqual((manifest["state"], sorted(manifest["models"])), ("done", ["continuum", "reduced"]))
        # A scene finds its mesh beside it.
        self.run_done("check", scenes / "rough_ball.prm", cwd=self.home)

    def check_manual(self):
        page = (self.shares / "man" / "man1" / "pseudorigid.1").read_text().replace("\\-", "-")
        entries = json.loads(self.run_done("parameters", "--format", "json").stdout)
        self.assertGreater(len(entries), 50)
        for entry in entries:
            self.assertIn(f'.BR "{entry["entry"]}" ', page)
        for subcommand in ("run", "check", "parameters", "report"):
            self.assertIn(self.run_done(subcommand, "--help").stdout.split("\n\nExit codes")[0], page)

    def check_completion(self):
        def completed(*words):
            """What is offered for the last word."""
            script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _pseudorigid; printf "%s\\n" "${COMPREPLY[@]}"'
            path = f"{self.program.parent}:{os.environ['PATH']}"
            return self.shell("bash", "-c", script, "bash", self.shares / "bash-completion" / "completions" / "pseudorigid",
                              "pseudorigid", *words, env={**os.environ, "PATH": path}).split("\n")[:-1]

        (self.home / "own.prm").touch()
        (self.home / "own.txt").touch()
        self.assertEqual(completed("r"), ["run", "report"])
        self.assertEqual(completed("run", "--re"), ["--resume"])
        self.assertEqual(completed("run", "ow"), ["own.prm"])
        self.assertEqual(completed("run", "own.prm", "--set", "Continuum/Ref"), ["Continuum/Refinements="])
        self.assertEqual(completed("run", "own.prm", "--set", "Initial state/Def"), ["Initial\\ state/Deformation="])
        self.assertEqual(completed("parameters", "--format", ""), ["prm", "markdown", "json"])

    def check_python(self):
        """The package finds the program that is installed with it, whatever else is on the path."""
        package = self.prefix / "lib" / "python3" / "dist-packages"
        environment = {**os.environ, "PYTHONPATH": str(package)}
        del environment["PSEUDORIGID"]
        ask = "import pseudorigid; print(pseudorigid.find_program(), pseudorigid.run({'Models': 'reduced', 'Time/End': 1}).models)"
        self.assertEqual(self.shell(sys.executable, "-c", ask, env=environment), f"{self.program} ['reduced']\n")
        examples = self.shares / "doc" / "pseudorigid" / "python" / "examples"
        self.assertEqual({path.name for path in examples.iterdir()}, {path.name for path in (SOURCE / "python/examples").glob("*.py")})

    def check_library(self):
        """The example, built with what is installed and nothing else."""
        example = self.shares / "doc" / "pseudorigid" / "examples" / "spherical_pendulum"
        self.shell("cmake", "-G", "Ninja", "-S", example, "-B", "example", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                   "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
        self.shell("cmake", "--build", "example")
        self.check_pendulum(self.home / "example" / "spherical_pendulum")

    def check_pendulum(self, program):
        """E = v²/2 = 0.32 at the start, and the momentum 0.8 about the vertical, which the method keeps. The energy is off by
        up to 2.4e-12 at this step (measured)."""
        lines = self.shell(program).splitlines()
        self.assertEqual(len(lines), 10)
        for line in lines:
            length, energy, momentum = re.search(r"\|q\| - 1 =\s+(\S+)  energy\s+(\S+)  momentum (\S+)", line).groups()
            self.assertLess(abs(float(length)), 1e-15)
            self.assertAlmostEqual(float(energy), 0.32, delta=1e-11)
            self.assertAlmostEqual(float(momentum), 0.8, delta=1e-14)

    def test_a_project_can_add_the_sources(self):
        """It keeps its build type and its names, is not warned of our headers, and compiles only what it links."""
        (self.home / "CMakeLists.txt").write_text(f"""
            cmake_minimum_required(VERSION 3.25)
            project(consumer LANGUAGES CXX)
            foreach(name app io scene systems continuum git_hash uninstall)
              add_custom_target(${{name}})
            endforeach()
            add_subdirectory({SOURCE} pseudorigid)
            add_executable(pendulum {SOURCE}/examples/spherical_pendulum/spherical_pendulum.cpp)
            target_link_libraries(pendulum PRIVATE pseudorigid::headers)
            target_compile_options(pendulum PRIVATE -Wall -Wextra -Wpedantic -Werror)
            add_library(everything INTERFACE)
            target_link_libraries(everything INTERFACE pseudorigid::pseudorigid pseudorigid::reduced pseudorigid::polynomial)
            get_target_property(options pseudorigid::mechanics INTERFACE_COMPILE_OPTIONS)
            get_target_property(extensions pseudorigid_mechanics CXX_EXTENSIONS)
            message(STATUS "build type [${{CMAKE_BUILD_TYPE}}] [${{CMAKE_RUNTIME_OUTPUT_DIRECTORY}}] [${{options}}] "
              "[${{extensions}}]")
            """)
        configured = self.shell("cmake", "-G", "Ninja", "-S", ".", "-B", "build")
        self.assertIn("build type [] [] [options-NOTFOUND] [extensions-NOTFOUND]", configured)
        built = self.shell("cmake", "--build", "build")
        self.assertEqual(built.count("Building CXX object"), 1, built)
        self.check_pendulum(self.home / "build" / "pendulum")

    def check_pages(self):
        """Links lead to what is installed as well, or to the sources."""
        pages = self.shares / "doc" / "pseudorigid"
        for page in [pages / "README.md", pages / "docs" / "install.md"]:
            for target in re.findall(r"\]\(((?!https?:)[^)#\s]+)", page.read_text()):
                link = pathlib.Path(os.path.normpath(page.parent / target))
                in_sources = SOURCE / link.relative_to(pages)
                self.assertTrue(link.exists() or in_sources.exists(), f"{page.name}: {target}")


if __name__ == "__main__":
    main()
