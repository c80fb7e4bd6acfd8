"""Tables of the cell kernels as (header, rows of texts), from the files of docs/benchmarks/data; None without data."""

from benchmark_data import read_rows

NONE = "–"


def name_of_kernel(name):
    name, slash, lanes = name.partition("/")
    return f"{name}, {lanes} lane{'s' * (lanes != '1')}" if slash else name


PROCESSORS = {"AMD EPYC": "fe_evaluation_amd.csv", "Intel Xeon": "fe_evaluation_intel.csv"}


def equal_width(data):
    """The force against that of FEEvaluation with the same number of lanes, for each kind of processor."""
    lines = []
    for processor, name in PROCESSORS.items():
        meshes = {}
        for r in read_rows(data, name):
            meshes.setdefault((r["degree"], int(r["unknowns"])), {})[r["kernel"]] = r
        for (degree, n_unknowns), of in sorted(meshes.items()):
            scalar, rival = (of[f"FEEvaluation/{n_lanes}"] for n_lanes in (1, 8))
            lines.append([processor, degree, str(n_unknowns),
                          *(f"{float(r['per_second']) / 1e6:.0f}" for r in (scalar, rival, of["force"])),
                          f"{float(of['force']['over_fe_evaluation']):.2f}",
                          f"{float(of['force']['best_per_second']) / float(rival['best_per_second']):.2f}",
                          *(f"{rival[column]} / {of['force'][column]}" for column in ("flops", "bytes"))])
    return (["processor", "k", "unknowns", "FEEvaluation, 1 lane", "FEEvaluation, 8 lanes", "force", "force / FEEvaluation, 8 lanes",
             "of the best rounds", "flops an unknown, FEEvaluation / force", "bytes an unknown, FEEvaluation / force"], lines) \
        if lines else None


def kernels(data):
    rows = read_rows(data, "kernels.csv")
    if not rows:
        return None
    names = [k for k in dict.fromkeys(r["kernel"] for r in rows)]
    of = {(r["degree"], r["kernel"]): r for r in rows}
    result = []
    for degree in dict.fromkeys(r["degree"] for r in rows):
        force = of[degree, "force"]
        result.append([degree, force["unknowns"],
                       *(f"{float(of[degree, name]['per_second']) / 1e6:.0f}" for name in names),
                       f"{float(force['per_second']) / float(force['roofline']):.2f}"])
    return ["k", "unknowns", *map(name_of_kernel, names), "force / roofline"], result


def kernels_of_degree(data, degree):
    """A column for each kernel: speed, what the machine would allow, and what was counted for that."""
    rows = [r for r in read_rows(data, "kernels.csv") if r["degree"] == degree]
    if not rows:
        return None

    def line(name, column, scale, digits=0):
        return [name, *(f"{float(r[column]) / scale:.{digits}f}" if float(r[column]) else NONE for r in rows)]

    return [f"k = {degree}, {rows[0]['unknowns']} unknowns", *(name_of_kernel(r["kernel"]) for r in rows)], [
        line("median", "per_second", 1e6), line("best", "best_per_second", 1e6), line("roofline", "roofline", 1e6),
        line("flops an unknown", "flops", 1),
        line("bytes an unknown", "bytes", 1)]


def kernel_sizes(data):
    """Speed over the size of the mesh, by the kernels' times of the part `steps`."""
    rows = [r for r in read_rows(data, "ball_steps.csv") if r["degree"] == "4" and r["ranks"] == "1"]
    kinds = ("force", "constraint", "rate", "reaction")
    return (["k = 4, unknowns", *kinds], [
        [r["unknowns"], *(f"{int(r['unknowns']) / float(r[f'{kind}_s']) / 1e6:.0f}" for kind in kinds)]
        for r in rows]) if rows else None
