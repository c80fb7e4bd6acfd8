#!/usr/bin/python3
"""Pictures, page and tables of the benchmarks, from the data that scripts/benchmark.sh has measured.

    tools/benchmark_page.py                  docs/benchmarks/data → docs/images, docs/benchmarks/index.html, and the
                                             tables of README.md and of pages of docs/ (PAGES)
    tools/benchmark_page.py --output DIR     DIR/data → DIR
    tools/benchmark_page.py --check          whether the tables are those of the data (no picture is made)

A table, or a text with numbers, stands between <!-- begin: NAME --> and <!-- end: NAME --> of a Markdown file and is
replaced as a whole; TABLES and TEXTS list the names. Markers of parts without data keep what they have.
"""

import argparse
import base64
import html
import pathlib
import re
import sys

import benchmark_sections as sections
import benchmark_tables as tables
import kernel_tables
import package  # noqa: F401
import release_tables
from pseudorigid.errors import WrongInput, exit_code_of

ROOT = pathlib.Path(__file__).resolve().parents[1]
TABLES = {
    "summary": tables.summary,
    "ladder": tables.ladder,
    "sl3": lambda data: tables.methods(data, "sl3"),
    "rigid_body": lambda data: tables.methods(data, "rigid_body"),
    "double_pendulum": lambda data: tables.methods(data, "double_pendulum"),
    "methods_together": tables.methods_together,
    "gravitating": lambda data: tables.methods(data, "gravitating"),
    "small_systems": tables.small_systems,
    "small_systems_short": tables.small_systems_short,
    "single_calls": lambda data: tables.calls(data, "single_calls.csv"),
    "self_gravity": lambda data: tables.calls(data, "self_gravity.csv"),
    "release": release_tables.release,
    "release_runs": release_tables.release_runs,
    "three_programs": release_tables.three_programs,
    "method_and_implementation": release_tables.method_and_implementation,
    "ranks_of_peers": release_tables.ranks,
    "modes_of_peers": release_tables.modes,
    "nearly_incompressible": release_tables.nearly_incompressible,
    "sizes_of_peers": release_tables.sizes,
    "references_of_release": release_tables.references,
    "static_figures": release_tables.static_figures,
    "static_figures_of_getfem": release_tables.static_figures_of_getfem,
    "peers": lambda data: release_tables.runs_of_peer(data, "fenicsx_release.csv"),
    "runs_of_midpoint": lambda data: release_tables.runs_of_peer(data, "implicit_midpoint.csv"),
    "runs_of_getfem": lambda data: release_tables.runs_of_peer(data, "getfem_release.csv"),
    "gravitating_release": tables.gravitating_release,
    "gravity_cost": tables.gravity_cost,
    "lamb": tables.lamb,
    "frequency": tables.frequency,
    "auto_discretization": tables.auto_discretization,
    "kernels": kernel_tables.kernels,
    "equal_width": kernel_tables.equal_width,
    "kernels_of_degree_4": lambda data: kernel_tables.kernels_of_degree(data, "4"),
    "kernel_sizes": kernel_tables.kernel_sizes,
    "steps": tables.steps,
    "ranks": tables.ranks,
    "scaling": tables.scaling,
    "figure_ranks": tables.figure_ranks,
    "gram_iterations": tables.gram_iterations,
    "skipping": tables.skipping,
    "skipped_parts": tables.skipped_parts,
    "long_run": tables.long_run,
    "long_run_growth": tables.long_run_growth,
    "machine": tables.machine,
    "parts": tables.parts,
}
TEXTS = {
    "release_reference": sections.reference_of_release,
    "rates_in_space": sections.rates_in_space,
    "lamb_reference": sections.reference_of_lamb,
    "frequency_reference": sections.reference_of_frequency,
    "machine_limits": sections.limits_of_the_machine,
    "long_run_drift": sections.drift_of_the_long_run,
    "summary_picture": sections.summary_picture,
    "dates": sections.dates,
}
PAGES = ("README.md", "docs/benchmarks.md", "docs/comparisons.md", "docs/kernels.md", "docs/parallel.md")
MARKERS = re.compile(r"(<!-- begin: (\w+) -->\n).*?(<!-- end: \2 -->)", re.DOTALL)


def as_markdown(table):
    header, rows = table
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def as_html(table):
    header, rows = table

    def kind(cell):
        return ' class="words"' if len(cell) > MOST_UNBROKEN else ' class="short"' if len(header) > 9 else ""

    def line(tag, cells):
        return "<tr>" + "".join(f"<{tag}{kind(cell)}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>\n"

    head = f"<thead>{line('th', header)}</thead>\n" if any(header) else ""
    return f'<div class="wide"><table>\n{head}{"".join(line("td", row) for row in rows)}</table></div>\n'


def spliced(text, data, path):
    def replacement(match):
        begin, name, end = match.groups()
        if name in TEXTS:
            text = TEXTS[name](data)
            return f"{begin}{text}\n{end}" if text else match[0]
        if name not in TABLES:
            raise WrongInput(f"{path}: there is no table or text {name}; tools/benchmark_page.py lists them")
        table = TABLES[name](data)
        return begin + as_markdown(table) + end if table else match[0]

    return MARKERS.sub(replacement, text)


MOST_UNBROKEN = 30  # characters of a cell that stays on one line
# What is wider than the page is moved sideways in a box of its own, with a shadow where it goes on.
STYLE = """body { font: 16px/1.5 sans-serif; max-width: 68em; margin: 1em auto; padding: 0 1em; color: #111; }
h2 { border-top: 1px solid #ccc; padding-top: 1em; margin-top: 2em; }
table { border-collapse: collapse; font-size: 14px; }
th, td { border: 1px solid #ccc; padding: 0.2em 0.6em; text-align: left; min-width: 4em; }
td { white-space: nowrap; }
td.short { white-space: normal; min-width: 4.8em; }
td.words { white-space: normal; min-width: 11em; overflow-wrap: anywhere; }
.wide { overflow-x: auto; margin: 1em 0;
  background: linear-gradient(to right, #fff, #fff) left / 14px 100% no-repeat local,
    linear-gradient(to left, #fff, #fff) right / 14px 100% no-repeat local,
    linear-gradient(to right, #bbb, #fff) left / 12px 100% no-repeat scroll,
    linear-gradient(to left, #bbb, #fff) right / 12px 100% no-repeat scroll; }
.picture svg, .picture img { display: block; min-width: 640px; max-width: 100%; height: auto;
  mix-blend-mode: multiply; }
@media print {
  .wide { overflow: visible; background: none; }
  .picture svg, .picture img { min-width: 0; }
  table { font-size: 10px; }
  tr, .picture { break-inside: avoid; }
  h2, .notes { break-after: avoid; }
}
.notes { color: #444; font-size: 14px; }"""


def inline(path, title):
    """A picture as a part of a page."""
    if path.suffix == ".png":
        content = base64.b64encode(path.read_bytes()).decode()
        return f'<img src="data:image/png;base64,{content}" alt="{html.escape(title)}">'
    text = path.read_text()
    return text[text.index("<svg"):]


def section(title, part, runs, paragraphs, figure, names, data):
    pieces = [f"<h2>{html.escape(title)}</h2>\n", *(f"<p>{html.escape(p)}</p>\n" for p in paragraphs if p)]
    run = runs.get(part)
    if run:
        pieces.append(f'<p class="notes">scripts/benchmark.sh {part}: {run["date"]}, load {run["load at start"]:.1f} '
                      f'at the start, {run["seconds"]} s, commit {run["commit"][:9]}'
                      f'{", --quick" if run["quick"] else ""}</p>\n')
    if figure:
        pieces.append(f'<div class="wide picture">{inline(figure, title)}</div>\n')
    for name in names:
        if table := TABLES[name](data):
            pieces.append(as_html(table))
    return "".join(pieces) if figure or any(TABLES[name](data) for name in names) else ""


def make_page(figures, data, images, target):
    runs = tables.read_runs(data)
    body = ["<h1>Benchmarks of pseudorigid</h1>\n", "<p>Written by scripts/benchmark.sh; nothing here is typed by hand "
            "but the descriptions of the problems. Times are compared within one part only.</p>\n",
            as_html(TABLES["machine"](data)), as_html(TABLES["parts"](data))]
    for title, part, paragraphs, draw, names in sections.sections(data):
        figure = draw(figures, data, images) if draw else None
        body.append(section(title, part, runs, paragraphs, figure, names, data))
    target.write_text('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" '
                      'content="width=device-width"><title>Benchmarks of pseudorigid</title>\n'
                      f'<style>{STYLE}</style></head>\n<body>\n{"".join(body)}</body></html>\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    target = arguments.output or ROOT / "docs/benchmarks"
    data = target / "data"
    pages = [] if arguments.output else [ROOT / name for name in PAGES]
    if arguments.check:
        stale = [str(page) for page in pages if spliced(page.read_text(), data, page) != page.read_text()]
        if stale:
            raise WrongInput(f"tables of {', '.join(stale)} are not those of {data}; run tools/benchmark_page.py")
        return
    import benchmark_figures as figures  # not for --check, which needs no matplotlib

    images = ROOT / "docs/images" if not arguments.output else target / "images"
    images.mkdir(parents=True, exist_ok=True)
    make_page(figures, data, images, target / "index.html")
    figures.draw_summary(data, images)
    for page in pages:
        page.write_text(spliced(page.read_text(), data, page))


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
