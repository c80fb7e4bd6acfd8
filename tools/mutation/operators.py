"""Mutants of C++ sources, one change to an equation, a condition or a statement each.

A mutant is a list of insertions into one line, so that all mutants of a file are compiled together (mutant_switch.h): where
the source has a + b, the copy has a + factor(17, -1) * b, which is a + b unless mutant 17 lives.
"""
import dataclasses
import re

# A line with one of these is no place for a mutant: declarations, what is evaluated while compiling, text.
NO_PLACE = re.compile(r'"|\'|^\s*(#|//|/\*|\*|template|using|static_assert|case |default:|friend|enum|struct|class|requires|'
                      r"typedef|concept|namespace|asm|constexpr|inline constexpr|static constexpr)|\bconsteval\b|\boperator\b|"
                      r"\bif constexpr\b|std::size_t>|\bsizeof\b")
OPERAND = r"(?=[\w(.])"
PLUS_MINUS = re.compile(r"(?<=[\w)\]}]) ([+-]=?) " + OPERAND)
UNARY_MINUS = re.compile(r"(?:(?<=[(,=?:] )|(?<=[(\[{])|(?<=return ))-" + OPERAND)
TIMES = re.compile(r"(?<=[\w)\]}]) ([*/]) " + OPERAND)
CONDITION = re.compile(r"\b(if|while) \(")
EXTREMUM = re.compile(r"std::(max|min)\((?!\{)")
STATEMENT = re.compile(r"^\s+(?!return\b|break\b|continue\b|throw\b|if\b|for\b|while\b|do\b|else\b|delete\b|goto\b|public\b|private\b)"
                       r"([A-Za-z_][\w.\[\]:]*(->\w+)*(\([^()]*\))?)( [-+*/]?= .*|\(.*\)|\+\+);$")
DECLARED = re.compile(r"^\s+(const |auto |static |mutable |double |int |bool |long |[A-Z]\w*(<.*>)? \w+( =|;|\{|\())")


@dataclasses.dataclass
class Mutant:
    file: str
    line: int               # from 1
    kind: str
    original: str           # the line
    mutated: str            # as it would be read
    edits: list             # [(column, length that is replaced, text with {n} for the number)]


def without_comment(line):
    return line.split("//")[0].rstrip()


def closing(line, start):
    """Place of the parenthesis that closes the one before `start`; None if it is on another line."""
    depth = 1
    for place in range(start, len(line)):
        depth += (line[place] == "(") - (line[place] == ")")
        if depth == 0:
            return place
    return None


def is_index(line, place):
    """Within brackets, or in the head of a loop: counting, not an equation. Such mutants crash at once."""
    return line.count("[", 0, place) > line.count("]", 0, place) or line.lstrip().startswith("for (")


def factors(line):
    """Signs, terms and factors."""
    for match in PLUS_MINUS.finditer(line):
        sign, place = match[1], match.end()
        if is_index(line, place):
            continue
        flipped = sign.translate(str.maketrans("+-", "-+"))
        yield "sign", line[:match.start(1)] + flipped + line[match.end(1):], [(place, 0, "{switch}factor({n}, -1) * ")]
        yield "term", line[:place] + "0 * " + line[place:], [(place, 0, "{switch}factor({n}, 0) * ")]
    for match in UNARY_MINUS.finditer(line):
        if is_index(line, match.end()):
            continue
        yield "sign", line[:match.start()] + line[match.end():], [(match.end(), 0, "{switch}factor({n}, -1) * ")]
    for match in TIMES.finditer(line):
        if is_index(line, match.end()):
            continue
        yield ("factor", line[:match.end()] + f"2 {match[1]} " + line[match.end():],
               [(match.end(), 0, f"{{switch}}factor({{n}}, 2) {match[1]} ")])


def conditions(line):
    for match in CONDITION.finditer(line):
        end = closing(line, match.end())
        if end is None:
            continue
        start = max(match.end(), line.rfind("; ", match.end(), end) + 2)
        text = line[start:end]
        if re.search(r"(?<![=!<>])=(?!=)", text):
            continue  # a declaration
        if match[1] == "if":
            yield ("always", line[:start] + "true" + line[end:],
                   [(start, 0, "{switch}lives({n}) || ("), (end, 0, ")")])
        yield ("never", line[:start] + "false" + line[end:],
               [(start, 0, "!{switch}lives({n}) && ("), (end, 0, ")")])


def extrema(line):
    for match in EXTREMUM.finditer(line):
        other = {"max": "min", "min": "max"}[match[1]]
        yield ("extremum", line[:match.start(1)] + other + line[match.end(1):],
               [(match.start(), match.end() - 1 - match.start(), f"{{switch}}{match[1]}<{{n}}>")])


def statements(line, before):
    if STATEMENT.match(line) and not DECLARED.match(line) and before.endswith((";", "{", "}", "")) \
            and (not before or before[-1] in ";{}"):
        place = len(line) - len(line.lstrip())
        yield "statement", line[:place] + ";", [(place, 0, "if (!{switch}lives({n})) ")]


def mutants_of(file, text):
    """All that the operators find in the bodies of functions."""
    lines = text.splitlines()
    before = ""
    for number, whole in enumerate(lines, 1):
        line = without_comment(whole)
        indented = len(line) - len(line.lstrip())
        if line and indented >= 2 and not NO_PLACE.search(line):
            for kind, mutated, edits in (*factors(line), *conditions(line), *extrema(line), *statements(line, before)):
                yield Mutant(file, number, kind, line.strip(), mutated.strip(), edits)
        if line.strip():
            before = line


def instrumented(text, numbered, header):
    """The text with the mutants [(number, Mutant)] of its file, at most one a line; lines keep their numbers."""
    lines = text.splitlines()
    for number, mutant in numbered:
        line = lines[mutant.line - 1]
        for column, length, inserted in sorted(mutant.edits, reverse=True):
            inserted = inserted.replace("{n}", str(number)).replace("{switch}", "::pseudorigid::mutation::")
            line = line[:column] + inserted + line[column + length:]
        lines[mutant.line - 1] = line
    return f'#include "{header}"\n#line 1\n' + "\n".join(lines) + "\n"
