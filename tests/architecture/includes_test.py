"""Whether every #include of src/ is one that the build allows: includes_test.py [SOURCE]

A layer is a folder of src/, a room a folder in it. What a layer may include is what its target links
(pseudorigid_layer(NAME … LIBS …) in its CMakeLists.txt), directly or through others; a room whose sources another target
compiles belongs to that one. Besides, no circle may lead from a room through others back to it, nor from a header to
itself, and only what links the continuum may include deal.II.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]) / "src"
INCLUDE = re.compile(r'^#include ["<]([^">]+)[">]', re.MULTILINE)
LAYER = re.compile(r"^\s*pseudorigid_layer\((\w+)([^)]*)\)", re.MULTILINE)


class Build:
    """What the CMakeLists.txt say: which target a folder belongs to, and what a target links."""

    def __init__(self):
        self.target_of_folder, self.links = {}, {}
        for listing in sorted(ROOT.glob("*/CMakeLists.txt")):
            layer = listing.parent.name
            for target, arguments in LAYER.findall(listing.read_text()):
                sources, _, libraries = arguments.partition("LIBS")
                self.links[target] = libraries.split()
                if target == layer:
                    self.target_of_folder[layer] = target
                else:
                    for folder in {pathlib.PurePath(source).parent.as_posix() for source in sources.split()[1:]}:
                        self.target_of_folder[f"{layer}/{folder}" if folder != "." else layer] = target
        # A target of single files in a layer's folder, as the information on the build, is no folder's.
        for layer in [name for name in self.links if (ROOT / name).is_dir()]:
            self.target_of_folder[layer] = layer

    def target_of(self, path):
        folder = pathlib.PurePath(path).parent.as_posix()
        return self.target_of_folder.get(folder) or self.target_of_folder[folder.split("/")[0]]

    def may_include(self, target):
        seen, waiting = {target}, [target]
        while waiting:
            for library in self.links.get(waiting.pop(), []):
                if library not in seen:
                    seen.add(library)
                    waiting.append(library)
        return seen


def includes():
    """File → what it includes, of all files in folders of src/ (those beside them put the executables together)."""
    files = [path for path in sorted(ROOT.glob("*/**/*")) if path.name.endswith((".h", ".cpp", ".cpp.in"))]
    return {path.relative_to(ROOT).as_posix(): INCLUDE.findall(path.read_text()) for path in files}


def circles(graph):
    """A circle for every node at which a walk along the arrows comes back to where it has been."""
    found, done = [], set()

    def walk(node, path):
        if node in path:
            found.append(path[path.index(node):] + [node])
        elif node not in done:
            for other in sorted(graph.get(node, ())):
                walk(other, path + [node])
            done.add(node)

    for node in sorted(graph):
        walk(node, [])
    return found


def problems():
    build, files = Build(), includes()
    rooms = {}
    for path, included in files.items():
        if path.split("/")[1].startswith("main"):  # an executable, which stands above all layers
            continue
        allowed = build.may_include(build.target_of(path))
        for header in included:
            if header.startswith("deal.II/") and "continuum" not in allowed:
                yield f"{path} includes {header}, but does not link the continuum"
            if header not in files:
                continue
            target = build.target_of(header)
            if target not in allowed:
                yield f"{path} includes {header}, but {build.target_of(path)} does not link {target}"
            rooms.setdefault(str(pathlib.PurePath(path).parent), set()).add(str(pathlib.PurePath(header).parent))
    for room, others in rooms.items():
        others.discard(room)
    for circle in circles(rooms):
        yield "a circle of rooms: " + " → ".join(circle)
    for circle in circles({path: [header for header in included if header in files] for path, included in files.items()}):
        yield "a circle of headers: " + " → ".join(circle)


def main():
    found = list(problems())
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)


main()
