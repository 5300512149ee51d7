#include "base/output_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/printable.h"
#include "facet/error.h"

namespace facet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryStart = ".facet-", kTemporaryEnd = ".part";
constexpr std::size_t kRandomDigits = 16;

// Has a fixed length, so that the target's name may have the maximum length.
std::string TemporaryName() {
  std::uint64_t random = 0;
  while (::getrandom(&random, sizeof random, 0) != sizeof random) {
    if (errno != EINTR) throw Error(ErrorCode::Internal, "the system gives no random numbers");
  }
  char digits[kRandomDigits + 1];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(random));
  return std::string(kTemporaryStart) + digits + std::string(kTemporaryEnd);
}

bool IsTemporaryName(std::string_view name) {
  if (!name.starts_with(kTemporaryStart) || !name.ends_with(kTemporaryEnd)) return false;
  name.remove_prefix(kTemporaryStart.size());
  name.remove_suffix(kTemporaryEnd.size());
  return name.size() == kRandomDigits && name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

fs::path FolderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Removes temporary files that no process has locked, as their writers were killed: only files of this user, and in a
// folder with very many files only the first ones, so that writing does not wait for long. After a look at many entries
// the folder is skipped for a while, so that writing a thousand files to it does not take a thousand looks.
void RemoveAbandonedFiles(const fs::path& folder) {
  constexpr int kMostEntries = 65536, kEntriesAFile = 64;
  static std::mutex mutex;
  static std::map<fs::path, int> owed_for;  // entries of the last look minus files written since
  std::error_code ignored;
  const fs::path key = fs::absolute(folder, ignored);
  {
    const std::lock_guard lock(mutex);
    if (int& owed = owed_for[key]; (owed -= kEntriesAFile) > 0) return;
  }
  DIR* const list = ::opendir(folder.c_str());
  if (list == nullptr) return;
  int entries = 0;
  for (; entries < kMostEntries; ++entries) {
    const dirent* const entry = ::readdir(list);
    if (entry == nullptr) break;
    if (!IsTemporaryName(entry->d_name)) continue;
    const int file = ::openat(::dirfd(list), entry->d_name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    struct stat status {};
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
        ::flock(file, LOCK_EX | LOCK_NB) == 0) {
      ::unlinkat(::dirfd(list), entry->d_name, 0);
    }
    ::close(file);
  }
  ::closedir(list);
  const std::lock_guard lock(mutex);
  owed_for[key] = entries;
}

// During its lifetime, writing beyond the limit on file sizes, or to a pipe without readers, fails with an error on
// this thread. Without it, a signal would end the process.
class WritesOnlyFail {
 public:
  WritesOnlyFail() {
    sigset_t pending;
    ::sigemptyset(&signals_);
    ::sigpending(&pending);
    for (const int signal : {SIGXFSZ, SIGPIPE}) {
      if (::sigismember(&pending, signal) == 0) ::sigaddset(&signals_, signal);  // one pending before is kept
    }
    ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~WritesOnlyFail() {
    const int error = errno;
    const timespec now{};
    while (::sigtimedwait(&signals_, nullptr, &now) > 0) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = error;
  }
  WritesOnlyFail(const WritesOnlyFail&) = delete;
  WritesOnlyFail& operator=(const WritesOnlyFail&) = delete;

 private:
  sigset_t signals_, before_;
};

enum class Kind { Plain, Special, ProcessFile };

// The file that a name finally leads to, and its kind. ProcessFile: an open file of a process, such as /dev/stdout,
// which can only be written to and not be replaced, whatever it is.
std::pair<fs::path, Kind> Follow(fs::path path) {
  constexpr int kMostLinks = 40;  // the same limit as in Linux
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, ignored)); ++i) {
    // /dev/fd/3 is a link into /proc, whose target for a file without name is text like "pipe:[123]".
    const fs::path folder = fs::canonical(FolderOf(path), ignored);
    if (folder.string().starts_with("/proc/")) return {path, Kind::ProcessFile};
    const fs::path next = fs::read_symlink(path, ignored);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  const fs::file_status status = fs::symlink_status(path, ignored);
  const bool plain =
      !fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status) || fs::is_symlink(status);
  return {path, plain ? Kind::Plain : Kind::Special};
}

// The path of a file that does not exist yet.
fs::path Canonical(const fs::path& path) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(Follow(path).first, ignored), ignored);
}

}  // namespace

OutputFile::OutputFile(const fs::path& path, Links links) : name_(Printable(path.string())) {
  if (path.native().find('\0') != std::string::npos) Fail(EINVAL);  // the operating system would end the name there
  if (links == Links::Refuse) {
    std::error_code ignored;
    const fs::file_type type = fs::symlink_status(path, ignored).type();
    if (type != fs::file_type::not_found && type != fs::file_type::regular) {
      throw Error(ErrorCode::OutputFailed, "cannot be written: it is no plain file", name_, "remove it first");
    }
    Open(path);
    return;
  }
  const auto [target, kind] = Follow(path);
  if (kind == Kind::Plain) {
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(target, ignored))) Fail(ELOOP);
    Open(target);
    return;
  }
  const int more = kind == Kind::ProcessFile ? O_APPEND : 0;
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | more);
  if (descriptor_ < 0) Fail(errno);
}

void OutputFile::Open(const fs::path& target) {
  const fs::path folder = FolderOf(target);
  RemoveAbandonedFiles(folder);
  target_ = target;
  constexpr int kMostTries = 16;
  for (int i = 0; i < kMostTries; ++i) {
    temporary_ = target.parent_path() / TemporaryName();
    unfinished_.emplace(temporary_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) {
      const int error = errno;
      unfinished_.reset();
      Fail(error);
    }
    unfinished_->WasMade();
    // Before it was locked, another process may have removed the file as abandoned.
    ::flock(descriptor_, LOCK_EX);
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || status.st_nlink > 0) {
      struct stat before {};
      if (::stat(target.c_str(), &before) == 0 && S_ISREG(before.st_mode))
        ::fchmod(descriptor_, before.st_mode & 0777u);
      return;
    }
    ::close(std::exchange(descriptor_, -1));
  }
  unfinished_.reset();
  Fail(EEXIST);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  ::close(descriptor_);
}

void OutputFile::Write(std::span<const std::byte> bytes) {
  const WritesOnlyFail quiet;
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) Fail(count < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void OutputFile::Rewrite(std::uint64_t offset, std::span<const std::byte> bytes) {
  const WritesOnlyFail quiet;
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) Fail(count < 0 ? errno : EIO);
    offset += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void OutputFile::Commit() {
  if (temporary_.empty()) {
    if (::close(std::exchange(descriptor_, -1)) != 0) Fail(errno);
    return;
  }
  // Without fsync the name may reach the disk before the bytes, and a loss of power may leave an empty file. Some file
  // systems report a full disk only here. Those that do not support it return EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS && errno != EROFS) Fail(errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) Fail(errno);
  unfinished_.reset();
  ::close(std::exchange(descriptor_, -1));
}

void OutputFile::Fail(int error) const {
  throw Error(ErrorCode::OutputFailed, std::string("cannot be written: ") + std::strerror(error), name_);
}

void WriteFile(const fs::path& path, std::initializer_list<std::span<const std::byte>> parts, OutputFile::Links links) {
  OutputFile file(path, links);
  for (const std::span<const std::byte> part : parts) file.Write(part);
  file.Commit();
}

void WriteFile(const fs::path& path, std::span<const std::byte> bytes, OutputFile::Links links) {
  WriteFile(path, {bytes}, links);
}

void WriteFile(const fs::path& path, const std::string& text) { WriteFile(path, std::as_bytes(std::span(text))); }

bool IsPlainFile(const fs::path& path) { return Follow(path).second == Kind::Plain; }

void CheckWritable(const fs::path& path) {
  const std::string name = Printable(path.string());
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw Error(ErrorCode::OutputFailed, "is a folder", name, "give the name of a file");
  }
  const auto [target, kind] = Follow(path);
  if (kind != Kind::Plain) return;
  const fs::path folder = FolderOf(target);
  if (!fs::is_directory(folder, ignored)) {
    throw Error(ErrorCode::OutputFailed, "the folder " + Quoted(folder.string()) + " does not exist", name,
                "create it first");
  }
  // The temporary file is created in the same folder and renamed, so the folder has to be writable.
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::OutputFailed,
                "the folder " + Quoted(folder.string()) + " cannot be written: " + std::strerror(errno), name);
  }
}

bool FileSet::Add(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return there_.emplace(status.st_dev, status.st_ino).second;
  return named_.insert(Canonical(path)).second;
}

bool FileSet::Has(const fs::path& path) const {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return there_.count({status.st_dev, status.st_ino}) > 0;
  return named_.count(Canonical(path)) > 0;
}

void RefuseOverwritingAnyOf(const FileSet& inputs, const std::vector<fs::path>& outputs) {
  FileSet before;
  for (const fs::path& output : outputs) {
    if (!IsPlainFile(output)) continue;
    const std::string name = Printable(output.string());
    if (!before.Add(output)) {
      throw Error(ErrorCode::InvalidUsage, "is given for two outputs", name, "give each a name of its own");
    }
    if (inputs.Has(output)) {
      throw Error(ErrorCode::InvalidUsage, "is also an input, and would be overwritten", name, "give another name");
    }
  }
}

void RefuseOverwriting(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  FileSet files;
  for (const fs::path& input : inputs) files.Add(input);
  RefuseOverwritingAnyOf(files, outputs);
}

}  // namespace facet
