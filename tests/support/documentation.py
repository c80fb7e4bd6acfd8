"""The commands of a page of documentation and what they print.

A page is read from top to bottom. Its blocks of the language `console` are run:

    $ command            a line of shell; a backslash at its end continues it
    output               what it prints, on stdout and stderr; a line … stands for any number of lines
    ↪ more of it         goes on with the line before, which is too long for a page

<!-- file: name --> above any block says that the block is a file of that name, written before what follows. Blocks of
other languages are for the reader.
"""
import dataclasses
import re
import subprocess
import textwrap

from program_test import SOURCE, TIME_LIMIT, without_free_space

BLOCK = re.compile(r"(?:<!-- file: (?P<file>\S+) -->\n\n?)?^```(?P<language>\w*)\n(?P<text>.*?)^```$",
                   re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
WIDTH, GOES_ON = 100, "↪ "  # a page of GitHub shows about 110 columns of a block
DURATION = re.compile(r"\b\d+(?:\.\d+)?(?:e-?\d+)? s\b")
# Processors and compilers round differently: numbers agree to three units of the last printed digit or to nine digits,
# and below 1e-11 a number says only that it is round-off.
UNITS_OF_LAST_DIGIT, DIGITS, ROUND_OFF = 3.0001, 1e-9, 1e-11


@dataclasses.dataclass
class File:
    name: str
    text: str


@dataclasses.dataclass
class Command:
    text: str  # as it stands on the page, without the $
    expected: list

    def run(self, folder):
        """What it prints there."""
        line = re.sub(r"\\\n\s*", "", self.text)
        return subprocess.run(["bash", "-c", line], cwd=folder, stdin=subprocess.DEVNULL, text=True, timeout=TIME_LIMIT,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout.splitlines()


def make_workplace(folder, program):
    """What a clone has for the commands of a page: build/release/bin/pseudorigid is `program`, and scripts/run.sh hands
    its arguments to it without building anything, and requests a report as the script does."""
    for name in ("params", "meshes", "python"):
        (folder / name).symlink_to(SOURCE / name)
    binaries = folder / "build" / "release" / "bin"
    binaries.mkdir(parents=True)
    for executable in program.parent.glob("pseudorigid*"):
        (binaries / executable.name).symlink_to(executable)
    script = folder / "scripts" / "run.sh"
    script.parent.mkdir()
    script.write_text('#!/bin/sh\n[ $# -gt 0 ] || set -- params/quickstart.prm\n'
                      'case "$*" in *Report*|*--resume*) ;; *) set -- "$@" --set Output/Report=true ;; esac\n'
                      'exec build/release/bin/pseudorigid run "$@"\n')
    script.chmod(0o755)


def steps(page):
    """The files and commands of a page in their order."""
    for block in BLOCK.finditer(page):
        if block["file"]:
            yield File(block["file"], block["text"])
        elif block["language"] == "console":
            yield from commands(block["text"])


def commands(text):
    command = None
    lines = iter(text.splitlines())
    for line in lines:
        if line.startswith("$ "):
            if command:
                yield command
            command = Command(line[2:], [])
            while command.text.endswith("\\"):
                command.text += "\n" + next(lines)
        elif line.startswith(GOES_ON):
            command.expected[-1] += " " + line.removeprefix(GOES_ON)
        else:
            command.expected.append(line)
    if command:
        yield command


def folded(line):
    """The line, in pieces that a page shows whole."""
    if len(line) <= WIDTH:
        return [line]
    indent = re.match(" *", line)[0]
    return textwrap.wrap(line.strip(), WIDTH, initial_indent=indent, subsequent_indent=GOES_ON, break_long_words=False, break_on_hyphens=False)


def printed_anew(page, folder):
    """The page with what its commands print now; what has a line … stays."""
    def of_block(block):
        if block["file"]:
            (folder / block["file"]).write_text(block["text"])
        if block["file"] or block["language"] != "console":
            return block[0]
        lines = []
        for command in commands(block["text"]):
            output = [line.rstrip() for line in command.run(folder)]
            printed = command.expected if "…" in command.expected else output
            lines += [f"$ {command.text}", *(piece for line in printed for piece in folded(line))]
        return "```console\n" + "\n".join(lines) + "\n```"
    return BLOCK.sub(of_block, page)


def last_digit(text):
    """The unit of the last digit of a number as it is printed: 1.7e-06 → 1e-7."""
    mantissa, _, exponent = text.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def same_number(a, b):
    """Up to a few units of the last digit. Numbers of one digit, as errors are, agree within a factor of two."""
    size, difference = max(abs(float(a)), abs(float(b))), abs(float(a) - float(b))
    return (size < ROUND_OFF or difference <= DIGITS * size or
            difference <= min(UNITS_OF_LAST_DIGIT * max(last_digit(a), last_digit(b)), size / 2))


def same_line(expected, printed):
    """Whether two lines agree apart from durations, the room on the disk, the last digits of numbers, and the spaces that align them."""
    expected, printed = (without_free_space(DURATION.sub("# s", line)) for line in (expected, printed))
    words = [re.sub(r"\s+", " ", NUMBER.sub("#", line)).strip() for line in (expected, printed)]
    numbers = [NUMBER.findall(line) for line in (expected, printed)]
    return words[0] == words[1] and all(same_number(a, b) for a, b in zip(*numbers))


def first_difference(expected, printed):
    """None, or what differs first."""
    at = 0
    for i, line in enumerate(expected):
        if line.strip() == "…":
            rest = expected[i + 1:]
            ends = [k for k in range(at, len(printed) + 1) if first_difference(rest, printed[k:]) is None]
            return None if ends else f"after … expected {rest}, got {printed[at:]}"
        if at == len(printed):
            return f"expected {line!r}, got no further line"
        if not same_line(line, printed[at]):
            return f"expected {line!r}, got {printed[at]!r}"
        at += 1
    return None if at == len(printed) else f"printed more: {printed[at]!r}"
