"""Writes levitas_msg/layouts.hpp: the layout of every message, for lcmtypes/checked_decode.hpp.

usage: lcm_layouts.py OUT.hpp TYPE.lcm ...

It reads what our messages use of LCM's language (primitive fields, texts, arrays of a fixed length
or of a count that stands before them) and refuses everything else, and a count without its limit.
"""

import re
import sys
from pathlib import Path

BYTES = {"byte": 1, "boolean": 1, "int8_t": 1, "int16_t": 2, "int32_t": 4, "int64_t": 8,
         "float": 4, "double": 8}
STRUCT = re.compile(r"^struct\s+(\w+)\s*\{\s*(?://.*)?$")
FIELD = re.compile(r"^(\w+)\s+(\w+)\s*(?:\[(\w+)\])?\s*;\s*(?://(.*))?$")
LIMIT = re.compile(r"@max (\d+)\b")


def fields_of(path):
    """(name of the type, its fields as (line number, type, name, dimension, comment))."""
    name, fields = None, []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("//") or re.match(r"package \w+;", line):
            continue
        if (struct := STRUCT.match(line)) and name is None:
            name = struct[1]
        elif name is not None and (field := FIELD.match(line)):
            fields.append((number, field[1], field[2], field[3], field[4] or ""))
        elif line != "}":
            sys.exit(f"{path}:{number}: not understood: {line}")
    return name, fields


def layout_of(path, fields):
    """Pieces of C++ in the order of the bytes."""
    dimensions = {dimension for _, _, _, dimension, _ in fields if dimension}
    slots, pieces, fixed = {}, [], 0
    for number, kind, name, dimension, comment in fields:
        where = f"{path}:{number}: {name}"
        counted = dimension is not None and not dimension.isdigit()
        if kind not in BYTES and kind != "string":
            sys.exit(f"{where}: its type {kind} is unknown here")
        if counted and dimension not in slots:
            sys.exit(f"{where}: its count {dimension} does not stand before it")
        if kind == "string" and dimension is not None and not counted:
            sys.exit(f"{where}: texts of a fixed number are unknown here")
        if kind != "string" and not counted and name not in dimensions:
            fixed += BYTES[kind] * int(dimension or 1)
            continue
        if fixed:
            pieces.append(f"BytesPiece({fixed})")
            fixed = 0
        if name in dimensions:
            limit = LIMIT.search(comment)
            if kind != "int32_t" or limit is None:
                sys.exit(f"{where}: a count is an int32_t and says // [1] @max N: ...")
            slots[name] = len(slots)
            pieces.append(f"CountPiece({slots[name]}, {limit[1]})")
        elif kind == "string":
            pieces.append(f"TextsPiece({slots[dimension]})" if counted else "TextPiece()")
        else:
            pieces.append(f"ArrayPiece({slots[dimension]}, {BYTES[kind]})")
    return pieces + ([f"BytesPiece({fixed})"] if fixed else [])


def header(paths):
    text = ["#pragma once", "// Written by cmake/lcm_layouts.py from lcmtypes/*.lcm.", "",
            '#include "lcmtypes/payload_layout.hpp"', ""]
    for path in paths:
        name, fields = fields_of(path)
        pieces = layout_of(path, fields)
        text += ["namespace levitas_msg {", f"class {name};", "}", "template <>",
                 f"inline constexpr std::array<levitas::message::Piece, {len(pieces)}>",
                 f"    levitas::message::kLayout<levitas_msg::{name}>{{{{"]
        text += [f"        levitas::message::{piece}," for piece in pieces] + ["    }};", ""]
    return "\n".join(text)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(header([Path(arg) for arg in sys.argv[2:]]), encoding="utf-8")
