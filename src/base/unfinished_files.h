// Files that must not outlive the process unfinished: what a signal's handler has to remove.
#pragma once

#include <filesystem>

namespace facet {

// Remembers the name of a file that is about to be made, for as long as the object lives. More than 256 at a time are
// not remembered: they are found later as abandoned files (see output_file.h). Thread-safe.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& path);
  ~UnfinishedFile();
  // To be called when the file has been made: waits for the end where that has begun meanwhile.
  void WasMade() const;
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

 private:
  int slot_ = -1;
};

// Removes every such file. For handlers of signals that end the process: it may be called from one, and whoever makes a
// further file meanwhile waits for the end.
void RemoveUnfinishedFiles() noexcept;

}  // namespace facet
