"""The list of quantitative statements (quantities.py): the reader of pages on sentences made for it, and the list of the tree."""
import unittest

import quantities


class Reader(unittest.TestCase):
    def test_quantities_of_a_text(self):
        for text, found in (("18.63 % too fast in 0.02 s", ["18.63%", "0.02s"]), ("below 2.5e-4, 10⁻⁶ and 2.1·10⁻⁵", ["2.5e-4", "10⁻⁶", "2.1·10⁻⁵"]),
                            ("takes 19 to 44 % of a step", ["19", "44%"]), ("154 of the 169 rows", ["154"]), ("the ratio is 16", ["16"]),
                            ("five to ten minutes", ["five", "ten"]), ("half an hour, a third of a second", ["halfanhour", "athirdofasecond"]),
                            ("α = −0.1042 at 5 r/c and 3 times", ["−0.1042", "5r/c", "3times"]), ("1,000 s", ["1,000s"]),
                            ("degree 4, N = 3 and 2 axes", [])):
            self.assertEqual(quantities.quantities(text), found, text)

    def test_paragraphs_without_code_links_and_generated_blocks(self):
        page = ("# 5 %\n\na 1.5 `2.5` [c](d.md#3.5) (5.29) version 0.1.0\nb 4.5\n\n- 5.5\n- 6.5\n\n| 7.5 |\n| 8.5 |\n\n```sh\n9.5\n```\n\n"
                "<!-- begin: x -->\n1.25\n<!-- end: x -->\n\n$$\n2.25\n$$\n")
        found = [quantities.quantities(text) for text in quantities.paragraphs(page)]
        self.assertEqual([q for q in found if q], [["1.5", "4.5"], ["5.5"], ["6.5"], ["7.5", "8.5"]])

    def test_values(self):
        for quantity, value in (("18.63%", "18.63"), ("10⁻⁶", "1e-6"), ("2.1·10⁻⁵", "2.1e-5"), ("−0.1042", "-0.1042"), ("1,000s", "1000"),
                                ("14kB", "14"), ("2.5e-4", "2.5e-4")):
            self.assertEqual(quantities.value(quantity), value)
        for quantity, number, same in (("19%", "0.194", True), ("19%", "19", True), ("19", "0.19", False), ("2e-4", "4.7e-4", False),
                                       ("0.09", "0.0804", True), ("1.186", "1.1885", False), ("−0.104", "-0.1042", True)):
            self.assertEqual(quantities.is_among(quantity, ["7", number]), same, (quantity, number))


class List(unittest.TestCase):
    ROW = {"page": "README.md", "fragment": "It is", "quantities": "5%", "kind": "chosen", "source": "README.md:pseudorigid"}

    def test_what_is_missing_is_found(self):
        def problems(page, **changes):
            return list(quantities.problems_of("a.md", page, [{**self.ROW, **changes}]))

        self.assertEqual(problems("It is 5 %.\n"), [])
        for page, changes in (("It is 5 % of 6 s.\n", {}), ("It is 4 %.\n", {}), ("It was 5 %.\n", {}), ("It is 5 %. It is.\n", {}),
                              ("It is 5 %.\n\nNew: 7 %.\n", {}), ("It is.\n", {}), ("`It is` 5 %.\n", {})):
            self.assertNotEqual(problems(page, **changes), [], page)

    def test_a_source_that_is_none_is_found(self):
        self.assertEqual(quantities.problem_of_source(self.ROW), "")
        for kind, source in (("guessed", "README.md"), ("chosen", "no such file"), ("chosen", "README.md:no such text"), ("test", "README.md"),
                             ("measured", "scripts/benchmark.sh"), ("printed", "by hand")):
            self.assertNotEqual(quantities.problem_of_source({**self.ROW, "kind": kind, "source": source}), "", kind)

    def test_every_statement_is_listed_and_has_a_source(self):
        self.assertEqual(list(quantities.problems()), [])

    def test_there_is_enough_to_draw_from(self):
        self.assertGreater(sum(row["kind"] == "printed" for row in quantities.rows()), 15)


if __name__ == "__main__":
    unittest.main()
