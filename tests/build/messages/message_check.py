"""Finds message fields without a unit, or with one that contradicts their name.

A field of an .lcm file is well described when its comment starts with a unit in brackets, the unit
is one of KNOWN_UNITS, the name's suffix says the same, and words follow. check() returns one
sentence per problem, each with file and line.
"""

import re

KNOWN_UNITS = {
    "m", "A", "s", "ns", "rad", "rad/s", "rad/s2", "N m", "%",
    "1",     # a count or a yes/no
    "enum",  # words of common/enums.hpp, or listed in the comment
    "bits",  # one meaning per bit
    "text",
    "SI",    # SI unit that depends on the fault, named in the text beside it
}

# Longest first: _rad_per_s2 ends in neither _s2 nor _per_s.
SUFFIX_UNITS = [
    ("_rad_per_s2", "rad/s2"), ("_rad_per_s", "rad/s"), ("_rad", "rad"), ("_ns", "ns"),
    ("_n_m", "N m"), ("_percent", "%"),
    ("_m", "m"), ("_a", "A"), ("_s", "s"),
]

FIELD = re.compile(r"^\s*(?P<type>[A-Za-z_]\w*)\s+(?P<name>\w+)\s*(\[[\w\]\[]*\])?\s*;\s*(?P<rest>.*)$")
COMMENT = re.compile(r"^//\s*\[(?P<unit>[^\]]*)\]\s*(?P<words>.*)$")


def expected_unit(name):
    """The unit that a field's name ends in, None when it names none."""
    for suffix, unit in SUFFIX_UNITS:
        if name.endswith(suffix):
            return unit
    return None


def check_field(name, rest):
    """The problem of one field, None when it is well described."""
    comment = COMMENT.match(rest)
    if comment is None:
        return f"{name} has no unit: write // [unit] and what it is"
    unit = comment["unit"]
    if unit not in KNOWN_UNITS:
        return f"{name} has the unknown unit [{unit}]; known: {', '.join(sorted(KNOWN_UNITS))}"
    expected = expected_unit(name)
    if expected is not None and unit not in (expected, "SI"):
        return f"{name} says [{unit}], its name says [{expected}]"
    if not comment["words"].strip():
        return f"{name} has a unit but no words"
    return None


def check(text, file_name):
    """(number of fields, problems) of one .lcm file."""
    fields = 0
    problems = []
    inside = False
    for number, line in enumerate(text.splitlines(), start=1):
        if re.match(r"^\s*(//.*)?$", line):
            continue
        if re.match(r"^\s*struct\b", line):
            inside = True
            continue
        if re.match(r"^\s*\}", line):
            inside = False
            continue
        if not inside:
            continue
        field = FIELD.match(line)
        if field is None:
            problems.append(f"{file_name}:{number}: not one field with its comment: {line.strip()}")
            continue
        fields += 1
        problem = check_field(field["name"], field["rest"])
        if problem is not None:
            problems.append(f"{file_name}:{number}: {problem}")
    if fields == 0:
        problems.append(f"{file_name}: no field found")
    return fields, problems
