// Writes the table of docs/models/lecture.md: lecture_energy [--update FILE]. Without an option it prints it.
#include "material/lecture_energy.h"

#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>

int main(int argc, char** argv) {
  const std::string table = facet::LectureEnergyTable();
  if (argc != 3 || std::string_view(argv[1]) != "--update") {
    std::cout << table;
    return 0;
  }
  std::ostringstream page;
  page << std::ifstream(argv[2]).rdbuf();
  std::string text = page.str();
  const std::string begin = "<!-- lecture_energy: begin -->\n", end = "<!-- lecture_energy: end -->";
  const std::size_t first = text.find(begin), last = text.find(end);
  if (first == text.npos || last == text.npos) {
    std::cerr << argv[2] << " has no place for the table\n";
    return 1;
  }
  text.replace(first + begin.size(), last - first - begin.size(), "\n" + table + "\n");
  std::ofstream(argv[2]) << text;
  return 0;
}
