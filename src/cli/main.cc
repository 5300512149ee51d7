// The facet program: parse, options, call.
#include <exception>
#include <new>
#include <string>
#include <variant>

#include "cli/console.h"
#include "cli/info_command.h"
#include "cli/options.h"
#include "cli/render_command.h"
#include "facet/error.h"

namespace {

using facet::ErrorCode;
using facet::ExitCode;

struct Run {
  void operator()(const facet::cli::TextRequest& request) const { facet::cli::PrintOutput(request.text); }
  void operator()(const facet::cli::RenderOptions& options) const { facet::cli::RunRender(options); }
  void operator()(const facet::cli::InfoOptions& options) const { facet::cli::RunInfo(options); }
};

}  // namespace

int main(int argc, char** argv) {
  try {
    std::visit(Run{}, facet::cli::ParseCommandLine(argc, argv));
    return 0;
  } catch (const facet::Error& error) {
    facet::cli::PrintError(error.what());
    return ExitCode(error.code());
  } catch (const std::bad_alloc&) {
    facet::cli::PrintError("out of memory; a smaller --size or fewer --threads need less");
    return ExitCode(ErrorCode::OutOfMemory);
  } catch (const std::exception& error) {
    facet::cli::PrintError(std::string("a defect of facet: ") + error.what());
    return ExitCode(ErrorCode::Internal);
  }
}
