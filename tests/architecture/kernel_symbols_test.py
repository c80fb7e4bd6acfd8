"""Whether kernels show the linker nothing but their tables: kernel_symbols_test.py NM LIBRARY…

What is inlined or instantiated in a kernel, std::vector included, is compiled for instructions of its own. If those
names were seen, the linker would take any one of the copies, for the rest of the program as well.
"""
import collections
import pathlib
import re
import subprocess
import sys

nm, libraries = sys.argv[1], sys.argv[2:]
wrong, n_tables = [], 0
for library in libraries:
    layer = re.fullmatch(r"libpseudorigid_(\w+)\.a", pathlib.Path(library).name)[1]
    listing = subprocess.run([nm, "-A", "--defined-only", "--extern-only", "--demangle", library], check=True,
                             capture_output=True, text=True).stdout
    names = collections.defaultdict(list)
    for line in listing.splitlines():
        place, _, rest = line.rpartition(".o:")
        names[place].append(rest.split(maxsplit=2)[2])
    table = re.compile(rf"pseudorigid_{layer}_\w+")
    for place, seen in names.items():
        tables = [name for name in seen if table.fullmatch(name)]
        n_tables += len(tables)
        if tables and len(seen) > 1:
            wrong.append(f"{place}.o shows {len(seen) - 1} names beside {tables[0]}, as {seen[0]}")
if n_tables == 0:
    wrong.append("no table of kernels is in " + " ".join(libraries))
sys.exit("\n".join(wrong) or 0)
