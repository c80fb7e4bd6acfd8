"""What check_page.py finds, and that the pages stay right when somebody adds a part as they say."""
import pathlib
import re
import unittest

from check_page import CHANGES, SOURCE, problems, problems_of_changes

PAGES = sorted((SOURCE / "docs").glob("adding_a_*.md"))
TABLE = "first,  //\nsecond,  //\nlast>;\n"


def page(kind, *lines):
    return f"<!-- file: whole -->\n```cpp\nwhole\n```\n\n<!-- {kind}: table -->\n```diff\n" + "\n".join(lines) + "\n```\n"


def found(text, table=TABLE):
    return list(problems(text, {"whole": "whole\n", "table": table}.get))


class CheckPage(unittest.TestCase):
    def test_lines_stand_in_order(self):
        self.assertEqual(found(page("changes", " first, //", "+new, //", " last>;")), [])
        self.assertEqual(found(page("changed", "+first, //", " last>;")), [])
        self.assertEqual(found(page("changed", "+first, //", "", " last>;")), [])
        for kind, *lines in (("changes", " last>;", " first, //"), ("changes", " third, //"), ("changed", "+third, //"),
                             ("changes", " first, //", "-last>;", "+last, //")):
            self.assertEqual(len(found(page(kind, *lines))), 1, lines)

    def test_every_block_says_whose_it_is(self):
        self.assertEqual(len(found(page("changes", "+new").replace("<!-- changes: table -->\n", ""))), 1)

    def test_pages_stay_right_when_others_have_added(self):
        """Somebody adds lines of another name wherever a page adds some, before and after the page's own."""
        self.assertGreater(len(PAGES), 5)
        for path in PAGES:
            text = path.read_text()
            self.assertEqual(list(problems(text)), [], path.name)
            additions = {}
            for _, file, changes in CHANGES.findall(text):
                for place in changes.split("\n\n"):
                    additions.setdefault(file, []).append(place.splitlines())

            def read(file):
                lines = pathlib.Path(SOURCE / file).read_text().splitlines()
                for place in additions.get(file, []):
                    new = [re.sub(r"\w+", r"\g<0>2", line[1:]) for line in place if line.startswith("+")]
                    here = {" ".join(line[1:].split()) for line in place}
                    for at in [i for i, line in enumerate(lines) if " ".join(line.split()) in here][::-1]:
                        lines[at + 1:at + 1] = new
                        lines[at:at] = new
                return "\n".join(lines) + "\n"

            self.assertEqual(list(problems_of_changes(text, read)), [], path.name)


if __name__ == "__main__":
    unittest.main()
