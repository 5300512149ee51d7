// The facet program: parses the command line and runs the command.
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <variant>

#include "cli/check_command.h"
#include "cli/console.h"
#include "cli/diff_command.h"
#include "cli/explain_command.h"
#include "cli/hash_command.h"
#include "cli/info_command.h"
#include "cli/models_command.h"
#include "cli/options.h"
#include "cli/process.h"
#include "cli/render_command.h"
#include "cli/report_command.h"
#include "cli/verify_command.h"
#include "facet/error.h"

namespace {

using namespace facet;
using namespace facet::cli;

// Returns the exit code of `command`. If it throws, prints one line about the error and returns the error's exit code.
int Guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const Error& error) {
    PrintError(error.what());
    return ExitCode(error.code());
  } catch (const std::bad_alloc&) {
    PrintError("out of memory; a smaller --size or fewer --threads need less, or raise --memory-limit");
    return ExitCode(ErrorCode::OutOfMemory);
  } catch (const std::exception& error) {
    PrintError(std::string("a defect of facet: ") + error.what());
    return ExitCode(ErrorCode::Internal);
  }
}

// For commands that compare: exit codes 0 and 1 mean equal and different, so every error becomes 2.
int Compared(const std::function<int()>& command) {
  bool finished = false;
  const int code = Guarded([&] {
    const int verdict = command();
    finished = true;
    return verdict;
  });
  return finished ? code : 2;
}

struct Run {
  int operator()(const TextRequest& request) const { return PrintOutput(request.text), 0; }
  int operator()(const RenderOptions& options) const { return RunRender(options), 0; }
  int operator()(const InfoOptions& options) const { return RunInfo(options), 0; }
  int operator()(const ModelsOptions& options) const { return RunModels(options), 0; }
  int operator()(const ReportOptions& options) const { return RunReport(options), 0; }
  int operator()(const ExplainOptions& options) const { return RunExplain(options), 0; }
  int operator()(const HashOptions& options) const { return RunHash(options), 0; }
  int operator()(const VerifyOptions& options) const {
    return Compared([&] { return RunVerify(options); });
  }
  int operator()(const DiffOptions& options) const {
    return Compared([&] { return RunDiff(options); });
  }
  int operator()(const CheckCommandOptions& options) const {
    return Compared([&] { return RunCheck(options); });
  }
};

}  // namespace

int main(int argc, char** argv) {
  HandleSignals();
  return Guarded([&] {
    const Command command = ParseCommandLine(argc, argv);
    LimitMemory(MemoryLimitOf(command), ThreadsOf(command));
    return std::visit(Run{}, command);
  });
}
