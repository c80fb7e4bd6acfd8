#!/usr/bin/python3
"""Makes a site of the pages, with search and formulas, and checks its links.

    tools/site_of_pages.py build/site            # then open build/site/index.html

Pages, links and anchors are those of the sources. Needs Debian's python3-myst-parser and libjs-katex.
"""

import argparse
import html
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import package  # noqa: F401
from pseudorigid.errors import WrongInput, exit_code_of

ROOT = pathlib.Path(__file__).resolve().parents[1]
KATEX = pathlib.Path("/usr/share/javascript/katex")
LINK = re.compile(r"\[((?:`[^`\n]*`|[^\[\]`\n])+)\]\((?!https?:|#)([^)\s#]+)(#[^)\s]*)?\)")
CONFIGURATION = """
project, html_title, author, copyright = "pseudorigid", "pseudorigid", "the pseudorigid authors", "the pseudorigid authors"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
mathjax_path = "katex/katex.min.js"  # KaTeX draws the formulas
root_doc = "README"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_dmath_allow_labels = False
html_theme = "alabaster"
html_theme_options = {"description": "How wrong is it to assume that an elastic body stays an ellipsoid?", "page_width": "1080px", "sidebar_width": "230px"}
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_js_files = [("katex/contrib/auto-render.js", {"defer": "defer"}), ("site.js", {"defer": "defer"})]
html_copy_source = False
"""
SCRIPT = """window.addEventListener("load", () => document.querySelectorAll("div.math, span.math").forEach(element =>
  renderMathInElement(element, {delimiters: [{left: "\\\\[", right: "\\\\]", display: true}, {left: "\\\\(", right: "\\\\)", display: false}]})));
"""
STYLE = """div.body { max-width: none; hyphens: none; }
div.body img { max-width: 100%; height: auto; }
table.docutils { display: block; overflow-x: auto; }
div.math { overflow-x: auto; overflow-y: hidden; }
"""


def pages():
    """The pages by their paths in the sources."""
    return [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md")), ROOT / "meshes" / "README.md"]


def navigation():
    """Titles of groups and their pages, from the index of the pages."""
    for section in re.split(r"^## ", (ROOT / "docs/README.md").read_text(), flags=re.M)[1:]:
        targets = re.findall(r"\]\(([^)#\s]+)\.md\)", section)
        yield section.partition("\n")[0], ["docs/" + t if not t.startswith("../") else t[3:] for t in targets]


def prepared(page):
    """The text of a page for MyST: links to files other than pages, which Sphinx does not know, are HTML."""
    def as_html(link):
        text, target, anchor = link[1], link[2], link[3] or ""
        if target.endswith(".md") or link.string[link.start() - 1:link.start()] == "!":
            return link[0]
        words = re.sub(r"`([^`]*)`", lambda code: f"<code>{html.escape(code[1])}</code>", text)
        return f'<a href="{target}{anchor}">{words}</a>'
    blocks = re.split(r"(^```.*?^```$)", page.read_text(), flags=re.M | re.S)
    blocks[::2] = [LINK.sub(as_html, text) for text in blocks[::2]]
    return re.sub(r"^```(prm|console)$", "```text", "".join(blocks), flags=re.M)


def stage(folder):
    """The sources of the site."""
    for page in pages():
        target = folder / page.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(prepared(page))
    with (folder / "README.md").open("a") as index:
        for title, names in navigation():
            index.write(f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n" + "\n".join(dict.fromkeys(names)) + "\n```\n")
        index.write("\n```{toctree}\n:hidden:\n\ndocs/README\nCHANGELOG\nmeshes/README\n```\n")
    shutil.copytree(ROOT / "docs/images", folder / "docs/images")
    static = folder / "_static"
    shutil.copytree(KATEX, static / "katex", ignore=shutil.ignore_patterns("*.mjs", "katex.js", "katex.css"))
    (static / "site.js").write_text(SCRIPT)
    (static / "site.css").write_text(STYLE)
    (folder / "conf.py").write_text(CONFIGURATION)


class Page(html.parser.HTMLParser):
    """Identifiers and references of a page."""

    def __init__(self, path):
        super().__init__()
        self.identifiers, self.references = set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.identifiers.add(value)
            elif name in ("href", "src") and value and not re.match(r"[a-z]+:", value):
                self.references.append(urllib.parse.unquote(value))


def copy_linked_files(site):
    """Files of the sources that pages lead to."""
    for page in pages():
        for _, target, _ in LINK.findall(page.read_text()):
            source = (page.parent / target).resolve()
            if source.is_file() and source.suffix != ".md" and source.is_relative_to(ROOT):
                copy = site / source.relative_to(ROOT)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, copy)
            elif source.is_dir():  # its files as a list
                copy = site / source.relative_to(ROOT)
                copy.mkdir(parents=True, exist_ok=True)
                for file in filter(pathlib.Path.is_file, source.iterdir()):
                    if file.suffix != ".md":
                        shutil.copyfile(file, copy / file.name)
                rows = "".join(f'<li><a href="{f.name}">{f.name}</a></li>' for f in sorted(copy.iterdir()) if f.is_file() and f.name != "index.html")
                if not (copy / "index.html").exists():
                    (copy / "index.html").write_text(f"<!DOCTYPE html><title>{source.name}</title><ul>{rows}</ul>")


def dead_links(site):
    known = {path.resolve(): Page(path) for path in site.rglob("*.html")}
    for path, page in known.items():
        for reference in page.references:
            file, _, anchor = reference.partition("#")
            target = (path.parent / file.partition("?")[0]).resolve() if file else path
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                yield f"{path.relative_to(site.resolve())}: {reference}"
            elif anchor and target in known and anchor not in known[target].identifiers:
                yield f"{path.relative_to(site.resolve())}: {reference} (no such anchor)"


def build(site):
    """Makes the site; returns the warnings of Sphinx and the dead links."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder)
        stage(source)
        made = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-b", "html", "-d", str(source / "_doctrees"), str(source), str(site)],
                              capture_output=True, text=True)
        if made.returncode:
            raise WrongInput(f"Sphinx failed: {made.stderr.strip()[-500:]}")
        warnings = [line.replace(folder + "/", "") for line in made.stderr.splitlines() if line.strip()]
    shutil.copytree(ROOT / "docs/images", site / "docs/images", dirs_exist_ok=True)
    copy_linked_files(site)
    (site / "index.html").write_text('<!DOCTYPE html><meta http-equiv="refresh" content="0; url=README.html"><a href="README.html">pseudorigid</a>\n')
    return warnings + list(dead_links(site))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("site", type=pathlib.Path, metavar="FOLDER")
    arguments = parser.parse_args()
    if not KATEX.is_dir():
        raise WrongInput("KaTeX is not installed; apt-get install libjs-katex")
    problems = build(arguments.site)
    if problems:
        raise WrongInput("the site has problems:\n" + "\n".join(problems))
    print(arguments.site / "index.html")


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
