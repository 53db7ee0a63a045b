#pragma once
// Files that a command would write over what it reads, or over each other: refused for every
// command in one place, from the command line, before anything is done.
//
// Written   the values of the options in kWrites below, the same in every command.
// Read      every other value that names a file: the command's arguments, the rig, controller and
//           scenario files (also shipped ones, and those that are the default), keys, catalogues.
// Same      see session::SameFile.
// Not done  files whose names a command makes itself (P_bode.svg of --svg P, those of a folder).
//           Those that a rig file names: where they are found, session::RefuseClash is called.
// Targets   the folder of every file named is there and can be written to; the name is none.
// Failure   a usage Problem that names both files; BadInput of a target.
// Thread    any.

#include <CLI/App.hpp>

namespace levitas::cli {

/// Of the parsed command and those above it.
void RefuseClashes(const CLI::App& app);

}  // namespace levitas::cli
