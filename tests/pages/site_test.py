#!/usr/bin/python3
"""The site of the pages (tools/site_of_pages.py): it is made without a warning, its links and anchors exist, it can be searched, and its
formulas are marked for KaTeX. Skipped without Debian's python3-myst-parser and libjs-katex.
"""
import importlib.util
import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tools"))
import site_of_pages  # noqa: E402


@unittest.skipUnless(importlib.util.find_spec("myst_parser") and site_of_pages.KATEX.is_dir(), "python3-myst-parser or libjs-katex is not installed")
class Site(unittest.TestCase):
    def test_site(self):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder) / "site"
            self.assertEqual(site_of_pages.build(site), [])
            for page in site_of_pages.pages():
                self.assertTrue((site / page.relative_to(SOURCE)).with_suffix(".html").is_file(), page)
            self.assertGreater((site / "docs/theory.html").read_text().count('class="math notranslate'), 10)
            self.assertIn("circulation", (site / "searchindex.js").read_text())
            # A link that leads nowhere is found.
            (site / "docs/glossary.html").unlink()
            self.assertTrue(any("glossary.html" in link for link in site_of_pages.dead_links(site)))


if __name__ == "__main__":
    unittest.main()
