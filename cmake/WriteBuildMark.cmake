# Writes the source file of levitas_build_mark (BuildMark.cmake): OUT from the contents of FILES.
string(REPLACE "," ";" FILES "${FILES}")
set(hashes "")
foreach(file IN LISTS FILES)
  file(SHA256 ${file} hash)
  string(APPEND hashes ${hash})
endforeach()
string(SHA256 mark "${hashes}")
string(SUBSTRING ${mark} 0 16 mark)
file(WRITE ${OUT} "#include \"cli/build_mark.hpp\"

namespace levitas {

const char* BuildMark() noexcept { return \"${mark}\"; }

}  // namespace levitas
")
