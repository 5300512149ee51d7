// The one exception type of the library.
#pragma once

#include <stdexcept>
#include <string>

namespace facet {

// What kind of thing went wrong. The program maps each to an exit code of its own (see ExitCode).
enum class ErrorCode {
  Internal,       // a defect of facet itself
  InvalidUsage,   // an argument or setting that cannot be obeyed
  NotFound,       // an input file does not exist or cannot be opened
  InvalidInput,   // an input file breaks its format's rules
  Unsupported,    // an input file requires something that facet does not have
  OutputFailed,   // an output file could not be written whole
  OutOfMemory,    // a request exceeds the memory limit, or what the machine has
  MissingModule,  // an optional module (OpenImageIO) is needed and not installed
};

// Every failure of the library. `what()` is one line: "WHERE: MESSAGE; HINT".
class Error : public std::runtime_error {
 public:
  // `message`: what is wrong. `where`: the file and the location in it, may be empty. `hint`: what the user can do
  // about it, may be empty. None of them ends in a full stop or contains a line break.
  Error(ErrorCode code, std::string message, std::string where = {}, std::string hint = {});

  ErrorCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }
  const std::string& where() const noexcept { return where_; }
  const std::string& hint() const noexcept { return hint_; }

 private:
  ErrorCode code_;
  std::string message_, where_, hint_;
};

// The exit code of the program for each kind of error:
// 1 Internal, 2 InvalidUsage, 3 NotFound, 4 InvalidInput, 5 Unsupported, 6 OutputFailed, 7 OutOfMemory,
// 8 MissingModule. 0 is success.
int ExitCode(ErrorCode code) noexcept;

}  // namespace facet
