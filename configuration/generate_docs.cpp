// Writes docs/configuration.md from the tables: generate_docs FILE.

#include <cstdio>
#include <fstream>

#include "configuration/text/documenter.hpp"

int main(int argc, char** argv) {
  // An option that is none would become a file of that name.
  if (argc != 2 || argv[1][0] == '-') {
    std::fputs("usage: generate_docs FILE\n", stderr);
    return 2;
  }
  std::ofstream file(argv[1], std::ios::binary);
  file << levitas::configuration::ConfigurationDocument();
  if (file.flush()) return 0;
  std::fprintf(stderr, "generate_docs: %s cannot be written\n", argv[1]);
  return 1;
}
