// Runs the facet program as a user does.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace facet::test {

struct Outcome {
  int exit_code = -1;  // negative: killed by that signal
  std::string out, err;
};

struct Conditions {
  std::size_t max_file_bytes = 0;  // writing a file beyond this fails; 0: no limit
};

// Standard input is empty and no stream is a terminal.
Outcome RunFacet(const std::vector<std::string>& arguments, const Conditions& conditions = {});

// A fresh folder that is removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::vector<std::string> Files() const;  // sorted names

 private:
  std::filesystem::path path_;
};

std::string ReadText(const std::filesystem::path& path);
void WriteText(const std::filesystem::path& path, const std::string& text);

// One line that begins with "facet: " and nothing else.
bool IsOneErrorLine(const std::string& text);

}  // namespace facet::test
