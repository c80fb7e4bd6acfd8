#!/usr/bin/python3
"""Plain English, as far as a program can see it (the rules are on the page of style, CONTRIBUTING.md#english).

    english.py             every place that breaks a rule: file:line: rule: the sentence
    english.py FILE…       the same for some files
    english.py --counts    the number of places in each file, in the form of english_baseline.txt
    english.py --rules     the number of places for each rule and kind of text
    english.py --lower     writes lower numbers into english_baseline.txt; it never writes a higher one

Read are the pages, the documentation of parameters (docs/parameters.md is printed from it), the messages of the program
(strings in calls of UserError, warn, failure and refuse), and the comments of headers. Needs Debian's python3-markdown-it.
"""
import collections
import dataclasses
import pathlib
import re
import sys

from markdown_it import MarkdownIt

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BASELINE = pathlib.Path(__file__).with_name("english_baseline.txt")
MARKDOWN = MarkdownIt("commonmark").enable(["table", "strikethrough"])
CODE = "‹code›"  # stands for code in a sentence, and counts as one word
LONGEST_SENTENCE = 30


@dataclasses.dataclass(frozen=True)
class Sentence:
    line: int
    text: str
    needs_verb: bool = False  # items, cells, captions and the first sentence of a comment may be titles


@dataclasses.dataclass(frozen=True)
class Finding:
    file: str
    line: int
    rule: str
    text: str

    def __str__(self):
        return f"{self.file}:{self.line}: {self.rule}: {self.text}"


# Sentences of a text.

ABBREVIATION = re.compile(r"\b(e\.g|i\.e|cf|vs|etc|approx|nos?|eqs?|figs?|vol|eds?|pp?|ch|sec|[Pp]roc|[Ss]oc|[Mm]ath|Ex)\.$|\.\.\.$|"
                          r"(^|[,(]|\b(and|by|see))\s*([A-Z]\. ?)+$")  # the last are initials of a name
END = re.compile(r"[.!?…]['\"”)*]*(?=\s+['\"“(]?(?:[A-ZÀ-ÞΑ-Ω‹0-9]|\w+\.(?:md|h|prm)\b|$))|\Z")


def split_sentences(text):
    """(offset, sentence) for each sentence of a text."""
    start = 0
    for end in END.finditer(text):
        stop = end.end()
        if ABBREVIATION.search(text[start:stop]) and stop < len(text):
            continue
        piece = text[start:stop]
        if piece.strip():
            yield start + len(piece) - len(piece.lstrip()), piece.strip()
        start = stop


def sentences_of(text, line, first=False, later=False):
    """The sentences of a text of several lines, the first of which is `line`; whether the first and the later need a verb."""
    for k, (offset, sentence) in enumerate(split_sentences(text)):
        yield Sentence(line + text.count("\n", 0, offset), " ".join(sentence.split()), later if k else first)


def page_sentences(page, later_in_cells=False):
    """Sentences of a page in Markdown. Headings, code, formulas and comments are left out."""
    tokens, depth = MARKDOWN.parse(page), collections.Counter()
    row = 1
    for before, token in zip([None, *tokens], tokens):
        depth[token.type.removesuffix("_open").removesuffix("_close")] += token.nesting
        row = token.map[0] + 1 if token.map else row
        if token.type != "inline" or before.type == "heading_open":
            continue
        parts = [{"softbreak": "\n", "hardbreak": "\n", "code_inline": CODE, "text": part.content,
                  "strong_open": "\x02", "strong_close": "\x02"}.get(part.type, "")
                 for part in token.children]
        text = re.sub(r"\$\$.*?\$\$|\$[^$\n]+\$", CODE, "".join(parts), flags=re.DOTALL)
        text = re.sub(r"^\x02[^\x02]*\.\x02", "", text).replace("\x02", "")  # the title of a paragraph, set in bold
        is_caption = token.content.startswith("*") and token.content.endswith("*")
        in_paragraph = not (depth["list_item"] or depth["table"] or is_caption)
        yield from sentences_of(text, row, in_paragraph, in_paragraph or (later_in_cells and depth["table"] > 0))


def parameter_sentences(page):
    """Sentences of docs/parameters.md, the cells of which are the documentation of entries."""
    return page_sentences(page, later_in_cells=True)


COMMENT = re.compile(r"^(.*?)\s*//[/!]?(<?) ?(.*)$")


def comment_sentences(source):
    """Sentences of the comments of a header. Lines that are indented further are code or tables."""
    block, start = [], 0
    for number, line in enumerate([*source.splitlines(), ""], 1):
        found = COMMENT.match(line) if '"' not in line.split("//")[0] else None
        text = found[3] if found and not re.match(r"\s|SPDX|NOLINT|clang-format", found[3]) else ""
        if block and (not text or found[1].strip()):
            yield from sentences_of(re.sub(r"`[^`]*`", CODE, "\n".join(block)), start, False, True)
            block = []
        if text:
            start = start if block else number
            block.append(text)


CALL = re.compile(r"\b(?:UserError|warn|failure|refuse|invalid)\(")
STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')


def call_text(source, start):
    """The text between a parenthesis that opens before `start` and the one that closes it."""
    depth, k = 1, start
    while k < len(source) and depth:
        literal = STRING.match(source, k)
        k, depth = (literal.end(), depth) if literal else (k + 1, depth + {"(": 1, ")": -1}.get(source[k], 0))
    return source[start:k - 1]


def message_sentences(source):
    """Sentences of the messages in a source: strings that follow one another are one text."""
    end = 0
    for call in CALL.finditer(source):
        if call.start() < end:
            continue
        inside = call_text(source, call.end())
        end = call.end() + len(inside)
        joined = re.sub(r'(?<!\\)"\s*\n\s*"', "", inside)
        for literal in STRING.findall(joined):
            text = re.sub(r"\{[^}]*\}", CODE, literal).replace('\\"', '"').replace("\\n", " ")
            yield from sentences_of(text, source.count("\n", 0, call.start()) + 1)


# Rules: each takes a sentence and is true if it breaks the rule.

def n_words(text):
    return len(re.findall(r"[^\W\d_][\w'’-]*|‹code›", text))


VERBS = """pull push wrap accept act add admit agree allow amplify answer appear apply arrive ask assume attract be bear become begin
behave belong bend bound break bring build call can carry cause change check choose circulate cite clone close coincide
collect combine come compare compile complete compute concern confirm conserve consist contain continue contribute converge
convert cost could count cover create cross cut decide declare define delete deliver depend derive describe determine die
differ disappear discard dissipate divide do draw drift drop end enter equal estimate evaluate exceed exclude exist expect
explain extend fail fall feed feel fill find finish fit flip follow forbid form gain gather get give go grow guess halve
handle happen have help hold hide ignore implement improve include increase indicate install integrate interrupt introduce
join judge jump keep kill know lack lead leave let lie limit link list listen lock look lose lower make mark match may
mean measure meet mend might miss move multiply must name need note observe occur offer omit open oscillate overwrite pass
pause pay perform permit place plot point precede predict prefer prescribe preserve prevent print produce project prove
provide pulsate put quote raise reach read receive record recover reduce refer refuse remain remove repeat replace report
represent require resolve rest restart restore restrict result return rewrite rise rotate round run sample satisfy save say
scale scan search see select send separate serve set settle share shift shorten should show shrink sit solve spin split stand
start state stay step stop store subtract succeed sum support switch take tangle tell tend terminate test think throw track
transform travel treat try turn understand update use vanish vary verify wait want warn will work would wrinkle write yield
lay precess swing balance support hand impose type rename map disturb normalise evaluate locate detect oscillate stretch stack solve chase""".split()
IRREGULAR = """is are am was were been being has had having does did done goes went gone ran came made gave given took
taken kept held met left led found fell fallen rose risen grew grown shown showed drawn drew wrote written read said put set
saw seen sent sat stood stuck thrown threw told thought understood began begun became broke broken built bought brought chose
chosen cannot can't don't doesn't isn't aren't won't let's it's there's spent lay lost meant paid""".split()
VERB_FORMS = {"dies", *IRREGULAR}
for verb in VERBS:
    root = verb[:-1] if verb.endswith("e") else verb
    VERB_FORMS |= {verb, verb + "s", verb + "es", root + "ed", verb + verb[-1] + "ed"}
    if verb.endswith("y"):
        VERB_FORMS |= {verb[:-1] + "ies", verb[:-1] + "ied"}


def is_fragment(sentence):
    words = re.findall(r"[a-z][a-z'’]*", sentence.text.lower())
    return (sentence.needs_verb and not sentence.text[0].islower() and sentence.text.endswith(".")
            and len(words) >= 3 and not any(word in VERB_FORMS for word in words) and not re.search(r"[=≤≥<>≈]|‹code›|^\w+: ", sentence.text))


# A clause with "what" or "where" may be a question, and may follow a verb that asks or answers one.
ASKED = (r"(say|tell|show|explain|decide|determine|know|see|ask|describe|find|state|learn|check|print|choose|remember|"
         r"depend|record|note)(s|es|n|ed|ing|d)?( on| out| of| about)?|said|told|shown|seen|about|knew|is that|matter")
PLACES = (r"(place|point|file|line|folder|directory|region|surface|cell|node|position|side|column|row|page|section|step|"
          r"boundary|interval|part|machine|state|chart|system|case|time|level|end|edge|layer|field|element|face|set|sample|"
          r"example|table|curve|spot|limit)s?")


def with_what(sentence):
    text = re.sub(rf"\b({ASKED}),? (and )?what\b|\bwhat to\b", "", sentence.text, flags=re.I)
    return not text.endswith("?") and re.search(r"\b[Ww]hat(ever)?\b(?!\()", text)


def with_where(sentence):
    text = sentence.text
    if text.endswith("?"):
        return False
    text = re.sub(rf"\b({ASKED}|{PLACES}|(every|no|any|some|else)),? (and )?where\b", "", text, flags=re.I)
    text = re.sub(r"\b(to|from|near|of|at|is|are|on|behind) where\b|, where\b|\bwhere (to|it is used|it is defined)\b", "", text)
    text = re.sub(r"^where\b|\b[Ww]here( \S+ [=≠<>≤≥]|[.,;:)]|$)", "", text)  # of formulas, and alone
    return re.search(r"\b[Ww]here\b", text)


def with_who(sentence):
    text = re.sub(r"\b(users?|readers?|authors?|people|persons?|those|anyone|students?|developers?|reviewers?|physicists?|"
                  r"astronomers?|contributors?|[A-Z][a-zé]+) ?,? who\b", "", sentence.text)
    return not text.endswith("?") and re.search(r"\b([Ww]ho(ever|m)?|[Ss]omebody|[Nn]obody|[Aa]nybody)\b", text)


PRIVATE = re.compile(
    r"\b(richest|poorest|richer model|poorer model|(stretches|starts|drawn|chosen|taken) by chance|long and flat|let go|set off|level to second order|likewise|"
    r"at hand|stands? (what|beside)|lets? go|come(s)? right|the word of|promises? of|its promises|"
    r"bears? (the|a|what|its|no)|asks? for (nothing|no)|knows? (nothing|of|no)|wants (a|an|the|no|to)|"
    r"says? (nothing|no)|say (nothing|no)|speaks? of|nor is|such a one|the one of|the ones of|a whole turn|as it likes)\b")
OPENINGS = re.compile(r"(Of|Nor|That of|Those of|The same of|Seen|Beside|Besides|Who|Likewise|Not that|Said|Such are|None of)\b"
                      r"(?! course\b)")

IS_NO = re.compile(r"(?<![Tt]here )(?<![Tt]here may )(?<![Tt]here can )(?<![Tt]here must )\b(is|are|was|were|be) no "
                   r"(?!more|longer|less|fewer|better|worse|[a-z]+er than\b)")

RULES = {
    "long": lambda s: n_words(s.text) > LONGEST_SENTENCE,
    "fragment": is_fragment,
    "beside": lambda s: re.search(r"\b[Bb]esides?\b", s.text),
    "who": with_who,
    "where": with_where,
    "what": with_what,
    "private": lambda s: PRIVATE.search(s.text),
    "opening": lambda s: OPENINGS.match(s.text.lstrip("*_(")) or re.search(r"\bthe same of\b", s.text),
    "is no": lambda s: IS_NO.search(s.text),
    "semicolons": lambda s: s.text.count(";") > 1 and re.search(r"[^\W\d_]", s.text.replace(CODE, "")),
}


def broken_rules(sentence):
    unquoted = dataclasses.replace(sentence, text=re.sub("“[^”]*”", CODE, sentence.text))
    return [rule for rule, breaks in RULES.items() if breaks(unquoted)]


# The whole tree.

def texts():
    """(kind of text, file, function that takes it apart) of everything that is read."""
    parameters = SOURCE / "docs/parameters.md"
    for path in [*sorted(SOURCE.glob("*.md")), *sorted((SOURCE / "docs").rglob("*.md")), *sorted((SOURCE / "meshes").glob("*.md"))]:
        yield ("parameters", path, parameter_sentences) if path == parameters else ("pages", path, page_sentences)
    for path in sorted((SOURCE / "src").rglob("*.h")):
        yield "comments", path, comment_sentences
    for path in sorted([*(SOURCE / "src").rglob("*.h"), *(SOURCE / "src").rglob("*.cpp")]):
        yield "messages", path, message_sentences


def findings():
    """(kind of text, finding) of the whole tree."""
    for kind, path, sentences in texts():
        name = str(path.relative_to(SOURCE))
        for sentence in sentences(path.read_text()):
            for rule in broken_rules(sentence):
                yield kind, Finding(name, sentence.line, rule, sentence.text)


def counts():
    return collections.Counter(finding.file for _, finding in findings())


def read_baseline(text):
    return {file: int(n) for file, n in (line.split() for line in text.splitlines() if line and not line.startswith("#"))}


HEAD = """# Places in each file that break a rule of plain English (english.py). A number may fall and never rise:
# english.py --lower writes lower numbers.
"""


def written_baseline(numbers):
    return HEAD + "".join(f"{file} {n}\n" for file, n in sorted(numbers.items()) if n)


def risen(now, baseline):
    """Files with more places than the baseline allows."""
    return sorted(file for file, n in now.items() if n > baseline.get(file, 0))


def lowered(now, baseline):
    return {file: min(n, now.get(file, 0)) for file, n in baseline.items()}


def print_rules():
    table = collections.Counter((finding.rule, kind) for kind, finding in findings())
    kinds = ("pages", "parameters", "messages", "comments")
    for rule in RULES:
        print(f"{rule:<11}", *(f"{kind} {table[rule, kind]:<5}" for kind in kinds))
    print(f"{'all':<11}", *(f"{kind} {sum(n for (_, k), n in table.items() if k == kind):<5}" for kind in kinds))


def main(arguments):
    if arguments == ["--rules"]:
        print_rules()
    elif arguments == ["--counts"]:
        print(written_baseline(counts()), end="")
    elif arguments == ["--lower"]:
        BASELINE.write_text(written_baseline(lowered(counts(), read_baseline(BASELINE.read_text()))))
    else:
        wanted = {str(pathlib.Path(name).resolve().relative_to(SOURCE)) for name in arguments}
        for _, finding in findings():
            if not wanted or finding.file in wanted:
                print(finding)


if __name__ == "__main__":
    main(sys.argv[1:])
