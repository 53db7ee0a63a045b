"""Rules about the text of source files: each takes text and returns what is wrong with it."""

import os
import re
from pathlib import Path

MAX_LINES = 400
MAX_COLUMNS = 100
MAX_BODY = 60
MAX_SUBJECT = 72
CODE = (".cpp", ".hpp", ".py", ".sh", ".cmake", ".lcm", ".js", ".css", ".html")
NOT_OURS = {".git", "sessions", "__pycache__"}

# Spelled in halves, so that this file obeys its own rule.
NOTE_TO_SELF = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
TEST_HEAD = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\(\s*(\w+),\s*(\w+)\)\s*\{", re.M)
GENERATED_DECODER = re.compile(r"(\.|->)decode(NoHash|_array)?\(")
STANDARD_ERROR = re.compile(r"\bstderr\b|\bcerr\b|\bclog\b|\bperror\(")
ASSERTION = re.compile(
    r"\b(EXPECT_\w+|ASSERT_\w+|FAIL\(|ADD_FAILURE\w*\(|(?:Expect|Assert)[A-Z]\w*(?:<[^;]*?>)?\()")


def source_files(root, suffixes=CODE):
    """Files of ours below `root`, without what is built or recorded."""
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(f for f in folders if f not in NOT_OURS)
        if Path(folder) == Path(root) and "build" in folders:  # tests/build is ours
            folders.remove("build")
        for name in sorted(files):
            path = Path(folder) / name
            if path.suffix in suffixes or (name == "CMakeLists.txt" and ".cmake" in suffixes):
                yield path


def too_long(text):
    count = text.count("\n")
    return [f"{count} lines, allowed {MAX_LINES}: split it by concern"] if count > MAX_LINES else []


def wide_comments(text):
    """The formatter leaves comments as they are."""
    return [f"line {number}: a comment of {len(line)} columns, allowed {MAX_COLUMNS}"
            for number, line in enumerate(text.splitlines(), 1)
            if len(line) > MAX_COLUMNS and line.lstrip().startswith("//")]


NO_FUNCTION = re.compile(r"\s*(?:namespace|class|struct|enum|union|extern)\b")
LAMBDA = re.compile(r"\[[&=\w, *]*\] ?[({]")


def long_functions(text):
    """In the project's format a body ends with a brace in the column in which its head begins."""
    found, lines = [], text.splitlines()
    for at, line in enumerate(lines):
        if not re.search(r"[\w)}] \{$", line) or line.lstrip().startswith("//"):
            continue
        start = at
        while start > 0 and lines[start].startswith("    "):
            start -= 1  # a head of several lines
        head = "".join(lines[start:at + 1])
        indent = len(head) - len(head.lstrip())
        if indent > 2 or NO_FUNCTION.match(head) or LAMBDA.search(head) or "(" not in head:
            continue
        close = next((number for number in range(at + 1, len(lines))
                      if lines[number].startswith(" " * indent + "}")), at)
        if close - at - 1 > MAX_BODY:
            found.append(f"line {start + 1}: a function of {close - at - 1} lines, allowed {MAX_BODY}")
    return found


def notes_to_self(text):
    return [f"line {number}: '{match.group()}': finish it, or describe the limit in words"
            for number, line in enumerate(text.splitlines(), 1)
            if (match := NOTE_TO_SELF.search(line))]


# Words that the field does not use, with its own (docs/conventions.md); they do not come back,
# not as part of a name either: kKeptBack, held_out_nat and SharpenLast hold one each.
RETIRED = {"inquiry": "search state", "oracle": "informed diagnosis", "kept back": "validation data",
           "kept aside": "validation data", "held out": "validation data", "rivals": "alternatives",
           "strays": "diverges", "straying": "divergence", "sharpen": "refine",
           "sharpened": "refined", "sharpening": "refining", "flown": "levitated",
           "carryover": "hold-out check", "hunt": "search"}
RETIRED_WORD = re.compile(r"\b(" + "|".join(RETIRED) + r")\b", re.IGNORECASE)
PART_OF_NAME = re.compile(r"_|(?<=[a-z0-9])(?=[A-Z])")


def retired_words(text):
    return [f"line {number}: '{match.group()}': say {RETIRED[match.group().lower()]}"
            for number, line in enumerate(text.splitlines(), 1)
            if (match := RETIRED_WORD.search(PART_OF_NAME.sub(" ", line)))]


def refused_message(subject, body):
    """The subject of a commit says what changed, its body why."""
    found = []
    if len(subject) > MAX_SUBJECT:
        found.append(f"subject of {len(subject)} characters, allowed {MAX_SUBJECT}: {subject}")
    if not body.strip():
        found.append(f"no body that says why: {subject}")
    return found


def decodes_unchecked(text):
    """LCM's generated decoders believe what they read: only DecodeChecked calls one."""
    return [f"line {number}: a message is decoded by message::DecodeChecked and nothing else"
            for number, line in enumerate(text.splitlines(), 1) if GENERATED_DECODER.search(line)]


def speaks_past_say(text):
    """Standard error may be closed, full or stopped: rt::Say alone survives that without waiting."""
    return [f"line {number}: texts for people go through rt::Say (rt/say.hpp)"
            for number, line in enumerate(text.splitlines(), 1)
            if STANDARD_ERROR.search(line.partition("//")[0])]


def _body(text, start):
    """From the brace at `start` to its partner; literals are short here, so braces are counted."""
    depth = 0
    for position in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[position], 0)
        if depth == 0:
            return text[start:position + 1]
    return text[start:]


def tests_without_assertion(text):
    """A helper that asserts is recognised by its name: Expect... or Assert..."""
    return [f"{match.group(1)}.{match.group(2)} asserts nothing"
            for match in TEST_HEAD.finditer(text)
            if not ASSERTION.search(_body(text, match.end() - 1))]


def header_without_description(text):
    """A header says what it is before its first include or declaration."""
    lines = text.splitlines()
    if not lines or lines[0] != "#pragma once":
        return ["the first line is not '#pragma once'"]
    following = next((line for line in lines[1:] if line.strip()), "")
    return [] if following.startswith("//") else ["does not start with a comment that says what it is"]


def lines_of(root, inside_tests):
    """Lines of C++ in tests, or outside them."""
    total = 0
    for path in source_files(root, (".cpp", ".hpp")):
        if ("tests" in path.relative_to(root).parts) == inside_tests:
            total += path.read_text(encoding="utf-8").count("\n")
    return total


INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
TOP = {"tests", "examples"}  # stand on everything


def folders_in_circles(root):
    """Of the folders at the top those that include each other, themselves or through others."""
    arrows = {}
    for path in source_files(root, (".cpp", ".hpp")):
        folder = path.relative_to(root).parts[0]
        for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
            if folder not in TOP and (Path(root) / name).exists():
                arrows.setdefault(folder, set()).add(name.split("/")[0])
    for folder, others in arrows.items():
        others.discard(folder)
    while ground := {folder for folder, others in arrows.items() if not others & set(arrows)}:
        arrows = {folder: others for folder, others in arrows.items() if folder not in ground}
    while roofs := set(arrows) - set().union(*arrows.values()):  # stand on a circle, in none
        arrows = {folder: others for folder, others in arrows.items() if folder not in roofs}
    return sorted(arrows)


# What a header has that a test can prove false: a function with a body, or one declared for a source
# beside it. Descriptions of plain data have neither.
BODY = re.compile(r"\)(?: const)?(?: noexcept)?(?: override)? \{|: \w+\(.*\) \{\}")


def untested_headers(root, folder):
    """Headers below `folder` with something to be tested that no file of tests includes."""
    root = Path(root)
    included = set()
    for path in source_files(root / "tests", (".cpp", ".hpp")):
        included.update(INCLUDE.findall(path.read_text(encoding="utf-8")))
    found = []
    for path in source_files(root / folder, (".hpp",)):
        name = path.relative_to(root).as_posix()
        behaves = path.with_suffix(".cpp").exists() or BODY.search(path.read_text(encoding="utf-8"))
        if name not in included and behaves:
            found.append(name)
    return found
