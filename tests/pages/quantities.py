#!/usr/bin/python3
"""The quantitative statements of the pages, and their sources.

    quantities.py                    what the list lacks and what it has in excess
    quantities.py --draw N --seed S  runs the commands of N statements drawn at random, and compares what they print

docs/data/quantities.csv has a row for each source of each paragraph: the page, a fragment of the paragraph that occurs once
on the page, the quantities that have this source, its kind, and the source.

    printed    a command prints them; --draw runs it where scripts/run.sh hands its arguments to the program PSEUDORIGID
    test       FILE or FILE:NAME in tests/, which compares them with a closed form, an exact value or a bound
    measured   date, and the command of the measurement
    chosen     FILE, which sets the value: a scene, the problem of a benchmark, a constant

A quantity is a number with a decimal point, an exponent or a unit, the first of "N of M", or an integer after "ratio". A
paragraph ends at an empty line or at the next item; a table is one. Code, formulas, links, equation numbers, versions and
blocks that a tool writes are left out.
"""
import argparse
import collections
import csv
import os
import pathlib
import random
import re
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LIST = SOURCE / "docs/data/quantities.csv"
PAGES = ("README.md", *(f"docs/{name}.md" for name in ("scope", "theory", "benchmarks", "comparisons", "kernels", "parallel",
                                                       "polynomial", "testing", "verification")), "CHANGELOG.md")
KINDS = ("printed", "test", "measured", "chosen")

SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
LEFT_OUT = (r"<!-- begin: (\w+) -->.*?<!-- end: \1 -->", r"^```.*?^```$", r"^\$\$.*?^\$\$$", r"<[^>]*>", r"`[^`\n]*`", r"\]\([^)\s]*\)",
            r"\b\d+(?:\.\d+){2,}\b", r"\((?:\d\.\d+(?:\.\d+)*(?:, |\)))+")
POWER = r"10⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+"
EXPONENT = rf"(?:e[+-]?\d+|\s?·\s?{POWER})"
UNIT = r"%|(?:ms|s|minutes|hours|bytes|kB|MB|GB|times|c/r|r/c)\b"
WORDS = "two three four five six seven eight nine ten eleven twelve fifteen eighteen twenty thirty".split()
NUMBER = (rf"[−-]?(?:{POWER}|\d[\d,]*\.\d+{EXPONENT}?|\d[\d,]*{EXPONENT}|"
          rf"\d[\d,]*(?=\s?(?:{UNIT})|\s(?:to|and|or)\s\d[\d.,]*\s?(?:{UNIT})|\sof\s(?:the\s)?\d+))(?:\s?(?:{UNIT}))?")
IN_WORDS = rf"\b(?:(?:{'|'.join(WORDS)})(?=(?:\sto\s\w+)?\s(?:minutes|hours|seconds))|(?:half an?|a third of a)\s(?:hour|second))"
QUANTITY = re.compile(rf"(?<![\w.^_]){NUMBER}|{IN_WORDS}")
RATIO = re.compile(r"\bratios?\b.*")  # integers after it count as well


def unreleased(text):
    """The part of a change log that can still change."""
    return re.split(r"^## (?=\d)", text, maxsplit=1, flags=re.M)[0]


def paragraphs(page):
    """The paragraphs of a page without what has other sources."""
    for pattern in LEFT_OUT:
        page = re.sub(pattern, lambda found: "‹›" if "\n" not in found[0] else "\n" * found[0].count("\n"), page, flags=re.M | re.S)
    return [text for text in re.split(r"\n\s*\n|\n(?=- |#)", page) if text.strip() and not text.lstrip().startswith("#")]


def quantities(text):
    found = [match[0] for match in QUANTITY.finditer(text)]
    found += [n for part in RATIO.findall(QUANTITY.sub("‹›", text)) for n in re.findall(r"(?<![\w√.^_])\d{2,}(?!\w)", part)]
    return [re.sub(r"\s", "", quantity).rstrip(",") for quantity in found]


def value(quantity):
    """The number of a quantity, in the form that float() reads."""
    number = re.sub(rf"({UNIT})$", "", quantity).replace(",", "")
    number = re.sub(rf"·?({POWER})$", lambda power: "e" + power[1].translate(SUPERSCRIPTS)[2:], number).translate(SUPERSCRIPTS)
    return "1" + number if number.startswith("e") else number


def is_among(quantity, numbers):
    """Whether a quantity is one of the printed numbers, to one unit of its last digit, since errors are rounded up; per cent may
    be printed as a fraction."""
    mantissa, _, exponent = value(quantity).partition("e")
    unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    scales = (1, 100) if quantity.endswith("%") else (1,)
    return any(abs(scale * float(number) - float(value(quantity))) <= unit for scale in scales for number in numbers)


def rows():
    with open(LIST, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def read_page(name):
    text = (SOURCE / name).read_text(encoding="utf-8")
    return unreleased(text) if name == "CHANGELOG.md" else text


def problems_of(name, page, listed):
    """What the rows of a page lack, and what they have in excess."""
    for row in listed:
        if (n := page.count(row["fragment"])) != 1:
            yield f"{name}: {row['fragment']!r} occurs {n} times"
    texts = paragraphs(page)
    yield from (f"{name}: {row['fragment']!r} is not in a paragraph that is read" for row in listed
                if not any(row["fragment"] in text for text in texts))
    for text in texts:
        found = collections.Counter(quantities(text))
        claimed = collections.Counter(q for row in listed if row["fragment"] in text for q in row["quantities"].split())
        if found != claimed:
            excess = " ".join((claimed - found).elements())
            yield (f"{name}: {text.strip()[:90]!r}: {LIST.name} lacks {' '.join((found - claimed).elements()) or 'nothing'}"
                   + (f", and has {excess}, which is not there" if excess else ""))


def problem_of_source(row):
    """Why a source is none, or an empty string."""
    kind, source = row["kind"], row["source"]
    if kind not in KINDS:
        return f"unknown kind {kind}"
    if kind == "measured":
        return "" if re.match(r"20\d\d-\d\d-\d\d: \S", source) else f"no date and command: {source}"
    if kind == "printed":
        return "" if re.match(r".*(scripts/run\.sh|docs/|/usr/bin/python3)", source) else f"no command: {source}"
    file, _, name = source.partition(":")
    path = SOURCE / file
    if kind == "test" and not file.startswith("tests/"):
        return f"no test: {source}"
    if not path.is_file() or name not in path.read_text(encoding="utf-8"):
        return f"there is no {source}"
    return ""


def problems():
    listed = rows()
    for name in PAGES:
        yield from problems_of(name, read_page(name), [row for row in listed if row["page"] == name])
    yield from (f"{row['page']}: a page that is not read" for row in listed if row["page"] not in PAGES)
    yield from (f"{row['page']}: {row['fragment']!r}: {problem}" for row in listed if (problem := problem_of_source(row)))


def draw(n, seed):
    """Runs the commands of n statements; the number of those whose quantities are not printed."""
    sys.path[:0] = [str(SOURCE / "tests/support"), str(SOURCE / "python")]
    import documentation  # not for the list alone, which needs no program

    n_missing = 0
    for row in random.Random(seed).sample([row for row in rows() if row["kind"] == "printed"], n):
        with tempfile.TemporaryDirectory() as folder:
            documentation.make_workplace(pathlib.Path(folder), pathlib.Path(os.environ["PSEUDORIGID"]).resolve())
            pathlib.Path(folder, "docs").symlink_to(SOURCE / "docs")
            printed = " | ".join(documentation.Command(row["source"], []).run(folder))
        numbers = documentation.NUMBER.findall(printed)
        missing = [q for q in row["quantities"].split() if not is_among(q, numbers)]
        n_missing += bool(missing)
        print(f"{row['page']}: {row['quantities']}\n  $ {row['source']}\n  {printed}")
        print(f"  MISSING: {' '.join(missing)}" if missing else "  as stated")
    return n_missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draw", type=int, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="S")
    arguments = parser.parse_args()
    if arguments.draw:
        return 1 if draw(arguments.draw, arguments.seed) else 0
    found = list(problems())
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
