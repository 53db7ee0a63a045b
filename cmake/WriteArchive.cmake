# One archive OUT of the static libraries FILES (separated by commas): a single object that shares no
# weak symbol with others (InstalledLibrary.cmake says why). LD, NM, OBJCOPY, AR: binutils.
cmake_policy(VERSION 3.25)
string(REPLACE "," ";" files "${FILES}")
get_filename_component(folder ${OUT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
set(object ${folder}/levitas.o)

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out COMMAND_ERROR_IS_FATAL ANY)
  set(out "${out}" PARENT_SCOPE)
endfunction()

# The names of the symbols of these kinds, as nm calls them.
function(symbols kinds result)
  run(${NM} --defined-only --format=posix ${object})
  string(REGEX MATCHALL "[^\n ]+ [${kinds}] " names "${out}")
  list(TRANSFORM names REPLACE " . $" "")
  set(${result} "${names}" PARENT_SCOPE)
endfunction()

run(${LD} -r --force-group-allocation -o ${object} --whole-archive ${files})
symbols(WV weak)
# Tables of our classes stay: a program that makes such an object needs them, and they hold no arithmetic.
list(FILTER weak EXCLUDE REGEX "^_ZT[VIS]N7levitas")
list(JOIN weak "\n" text)
file(WRITE ${folder}/weak.txt "${text}\n")
# What is one in the whole program (kind u) cannot be made local: it gets a name that no other has.
symbols(u single)
list(TRANSFORM single REPLACE "(.+)" "\\1 levitas_own\\1" OUTPUT_VARIABLE renamed)
list(JOIN renamed "\n" text)
file(WRITE ${folder}/renamed.txt "${text}\n")
run(${OBJCOPY} --localize-symbols=${folder}/weak.txt --redefine-syms=${folder}/renamed.txt ${object})
file(REMOVE ${OUT})
run(${AR} rcs ${OUT} ${object})
file(REMOVE ${object} ${folder}/weak.txt ${folder}/renamed.txt)
