"""The checker of plain English (english.py) on sentences made for it, and the tree against english_baseline.txt."""
import collections
import re
import unittest

import english

BAD_AND_GOOD = {
    "long": ("word " * 31 + "ends.", "word " * 29 + "ends."),
    "fragment": ("A number of the last digits.", "A number has a last digit."),
    "beside": ("The time stands beside the error.", "The table gives the time and the error."),
    "who": ("Who starts it gets a number.", "Users who start it get a number."),
    "where": ("It stops where the norm grows.", "It stops if the norm grows."),
    "what": ("It prints the sum of what is left.", "It prints the sum of the remaining terms."),
    "private": ("A ball that is let go vibrates.", "A ball that is released vibrates."),
    "opening": ("Of the ball it takes the mass.", "It uses the mass of the ball."),
    "is no": ("A device is no file.", "A device is not a file."),
    "semicolons": ("One is; two are; three are.", "One is; two are."),
}


def rules(text, needs_verb=True):
    return english.broken_rules(english.Sentence(1, text, needs_verb))


class Rules(unittest.TestCase):
    def test_each_rule_tells_a_bad_sentence_from_a_good_one(self):
        self.assertEqual(BAD_AND_GOOD.keys(), english.RULES.keys())
        for rule, (bad, good) in BAD_AND_GOOD.items():
            self.assertIn(rule, rules(bad))
            self.assertEqual(rules(good), [], rule)

    def test_good_sentences_are_no_false_alarms(self):
        for text in ("The message says where the run stopped and what to do.", "What remains of the difference?",
                     "The point where two axes cross is found.", "The boundary is a surface, where the traction is zero.",
                     "There is no mesh.", "There may be no solution.", "The step is no larger than the interval.",
                     "Physicists who measure it need one run.", "The window stands for the run.", "Of course it ends.",
                     "The error is ‹code› = 3.", "Type the command.",
                     "It is singular where a = b.", "where c is the speed of sound.", "It prints “is no file beside it”."):
            self.assertEqual(rules(text), [], text)

    def test_variants_of_bad_sentences(self):
        for rule, text in (("where", "Where it converges, it is fast."), ("what", "What is left is error."),
                           ("who", "It asks whoever calls it."), ("who", "It waits until nobody reads it."),
                           ("opening", "Nor is there a mesh."), ("beside", "Besides, it is fast."), ("opening", "It has the same of the ball.")):
            self.assertIn(rule, rules(text), text)

    def test_titles_need_no_verb(self):
        self.assertEqual(rules("A number of the last digits.", needs_verb=False), [])


class Sentences(unittest.TestCase):
    def test_where_sentences_end(self):
        for text, n in (("One is. Two are.", 2), ("It is 1.5 long, e.g. here.", 1), ("See i.e. This one. And that.", 2), ("Is it? It is!", 2),
                        ("Two: one is. ‹code› is two.", 2), ("W. M. Oliva writes it.", 1),
                        ("It has the normal n. On x it is F. In P it is 1.", 3), ("It is long. glossary.md lists it.", 2)):
            self.assertEqual(len(list(english.split_sentences(text))), n, text)

    def test_words(self):
        self.assertEqual(english.n_words("The ball's ‹code› is well-kept: 3.5 (μ)."), 6)

    def test_a_page(self):
        page = ("# What stands beside\n\nOne is\nhere. Two `beside`\nare.\n\n**A title.** A **part** is.\n\n- an item\n\n| what |\n|---|\n| beside it |\n\n"
                "```sh\nbeside\n```\n\n$$\nbeside\n$$\n\n![beside](x.png)\n")
        self.assertEqual([(s.line, s.text, s.needs_verb) for s in english.page_sentences(page) if s.text != english.CODE],
                         [(3, "One is here.", True), (4, "Two ‹code› are.", True), (7, "A part is.", True), (9, "an item", False),
                          (11, "what", False), (13, "beside it", False)])

    def test_a_header(self):
        header = ('/// The size. Of all\n/// parts.\n///     beside();\n///\n/// A part.\nint n;  ///< what it is\nauto x = "// beside";\n// SPDX-License-Identifier: MIT\n')
        self.assertEqual([(s.line, s.text, s.needs_verb) for s in english.comment_sentences(header)],
                         [(1, "The size.", False), (1, "Of all parts.", True), (5, "A part.", False), (6, "what it is", False)])

    def test_the_page_of_parameters(self):
        page = "A title.\n\n| entry | text |\n|---|---|\n| `a` | A title. A part. |\n"
        self.assertEqual([s.needs_verb for s in english.parameter_sentences(page) if "A" in s.text], [True, False, True])

    def test_messages(self):
        source = ('throw UserError(fmt::format("{}: the entry (a) "\n  "is {} beside", f(")")));\nlog->info("beside");\n'
                  'return Status::failure("One ends. Two end.");')
        self.assertEqual([(s.line, s.text) for s in english.message_sentences(source)][:1], [(1, "‹code›: the entry (a) is ‹code› beside")])
        self.assertEqual([(s.line, s.text) for s in english.message_sentences(source)][-2:], [(4, "One ends."), (4, "Two end.")])


class Baseline(unittest.TestCase):
    def test_numbers_fall_and_never_rise(self):
        baseline = english.read_baseline("# head\na.md 2\nb.md 1\n")
        self.assertEqual(baseline, {"a.md": 2, "b.md": 1})
        self.assertEqual(english.risen(collections.Counter({"a.md": 2, "b.md": 1}), baseline), [])
        self.assertEqual(english.risen(collections.Counter({"a.md": 3, "new.md": 1}), baseline), ["a.md", "new.md"])
        self.assertEqual(english.lowered({"a.md": 5, "new.md": 1}, baseline), {"a.md": 2, "b.md": 0})
        self.assertEqual(english.written_baseline({"b.md": 0, "a.md": 2}).splitlines()[-1], "a.md 2")

    def test_every_kind_of_text_is_read(self):
        read = collections.Counter(kind for kind, path, sentences in english.texts() for _ in sentences(path.read_text()))
        for kind in ("pages", "parameters", "messages", "comments"):
            self.assertGreater(read[kind], 100, kind)

    def test_no_file_has_more_places_than_the_baseline(self):
        found = [str(finding) for _, finding in english.findings()]
        baseline = english.read_baseline(english.BASELINE.read_text())
        worse = english.risen(english.counts(), baseline)
        places = [text for text in found if text.split(":")[0] in worse]
        self.assertEqual(worse, [], "\n".join([f"{file}: {baseline.get(file, 0)} are allowed" for file in worse] + places))

    def test_the_page_of_style_has_a_bad_and_a_good_sentence_for_each_rule(self):
        page = (english.SOURCE / "CONTRIBUTING.md").read_text()
        rows = re.findall(r"^\| (\d+) \| [^|]+ \| “([^|]+)” \| “([^|]+)” \|$", page, re.M)
        self.assertEqual([int(number) for number, _, _ in rows], list(range(1, 15)))
        for _, bad, good in rows:
            self.assertEqual(rules(good), [], good)


if __name__ == "__main__":
    unittest.main()
