#!/usr/bin/python3
"""Adds to FOLDER/runs.json what a part of the benchmarks ran on, and with what.

    benchmarks/machine.py FOLDER PART SECONDS LOAD PROGRAM [--quick]

SECONDS: how long the part took; LOAD: the load average when it started; PROGRAM: the executable, which knows compiler,
flags, libraries and commit.
"""
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PACKAGES = ("libgsl-dev", "libboost-dev", "libsundials-dev", "python3-scipy", "libdeal.ii-dev", "libpetsc-real-dev",
            "libopenblas0-serial", "libopenblas0-pthread", "python3-dolfinx-real", "python3-getfem++")


def first_match(path, pattern):
    found = re.search(pattern, pathlib.Path(path).read_text(), re.MULTILINE)
    return found[1].strip() if found else "unknown"


def machine():
    lines = subprocess.run(["lscpu"], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}).stdout
    fields = dict(line.split(":", 1) for line in lines.splitlines() if ":" in line)
    wide = [name for name in ("avx512f", "avx2", "fma") if name in fields.get("Flags", "")]
    memory = int(first_match("/proc/meminfo", r"^MemTotal:\s*(\d+)")) / 2**20
    return {
        "processor": first_match("/proc/cpuinfo", r"^model name\s*:(.*)"),
        "cores": f"{os.cpu_count()} logical, {fields.get('Thread(s) per core', '?').strip()} a core"
                 + (", virtual machine" if "Hypervisor vendor" in fields else ""),
        "vector instructions": ", ".join(wide) or "no wide ones",
        "caches": ", ".join(f"{name} {fields[f'{name} cache'].strip()}" for name in ("L1d", "L2", "L3")
                            if f"{name} cache" in fields),
        "memory": f"{memory:.0f} GiB",
        "system": first_match("/etc/os-release", r'^PRETTY_NAME="?([^"\n]*)')
                  + f", Linux {os.uname().release.partition('-')[0]}",
    }


def build(executable):
    """By the manifest of a run that does as good as nothing."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.prm"
        scene.write_text("set Models = reduced\nsubsection Time\nset End = 1e-3\nend\n")
        subprocess.run([executable, "run", scene, "--quiet", "--output", f"{folder}/out"], check=True)
        manifest = json.loads((pathlib.Path(folder) / "out/manifest.json").read_text())
    return {"compiler": manifest["compiler"], "flags": f"{manifest['flags']}; cell kernels: -march=native",
            "commit": manifest["git_hash"]}


def packages():
    command = ["dpkg-query", "--show", "--showformat=${db:Status-Status} ${Package} ${Version}\n", *PACKAGES]
    lines = subprocess.run(command, capture_output=True, text=True).stdout.splitlines()
    return ", ".join(line.removeprefix("installed ") for line in lines if line.startswith("installed "))


def main():
    if len(sys.argv) < 6:
        raise SystemExit(__doc__)
    folder, part, seconds, load, executable, *options = sys.argv[1:]
    path = pathlib.Path(folder) / "runs.json"
    runs = json.loads(path.read_text()) if path.exists() else {}
    runs[part] = {
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        "seconds": int(seconds), "load at start": float(load), "quick": "--quick" in options,
        **machine(), **build(executable), "packages": packages(),
    }
    path.write_text(json.dumps(runs, indent=1, sort_keys=True) + "\n")


if __name__ == "__main__":
    main()
