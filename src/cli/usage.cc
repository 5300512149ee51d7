#include "cli/usage.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <vector>

#include "base/printable.h"

namespace facet::cli {
namespace {

// CLI11's help page without its blank lines, and with a usage line that includes the required options.
class Page : public CLI::Formatter {
 public:
  explicit Page(std::string usage) : usage_(std::move(usage)) { label("Positionals", "Arguments"); }
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode mode) const override {
    std::string text = app->get_description() + "\n\nUsage: " + usage_ + "\n" + make_positionals(app);
    for (const std::string& group : app->get_groups()) {
      const std::vector<const CLI::Option*> options = app->get_options(
          [&group](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
      if (!options.empty()) text += make_group(group, false, options);
    }
    return text + make_subcommands(app, mode) + "\n" + make_footer(app);
  }
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    const std::string name = CLI::Formatter::make_option_name(option, is_positional);
    return name == "--stats{table}" ? "--stats[=json]" : name;
  }

 private:
  std::string usage_;
};

// The Levenshtein distance, for suggestions.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

// The option or command of `app` whose name is nearest to `text`; empty if none is near.
std::string Nearest(const CLI::App& app, const std::string& text) {
  std::string best;
  std::size_t best_distance = 3;
  const auto consider = [&](const std::string& name) {
    const std::size_t distance = EditDistance(text, name);
    if (distance < best_distance && distance < name.size()) {
      best_distance = distance;
      best = name;
    }
  };
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) consider("--" + name);
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    consider(command->get_name());
  }
  return best;
}

}  // namespace

void SetPage(CLI::App& app, const std::string& usage) { app.formatter(std::make_shared<Page>(usage)); }

Error UsageError(const CLI::App& app, const CLI::ParseError& complaint) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string page = chosen.empty() ? "'facet --help'" : "'facet " + command.get_name() + " --help'";
  std::vector<std::string> extras = app.remaining(true);
  extras.erase(std::remove(extras.begin(), extras.end(), "--"), extras.end());
  if (!extras.empty()) {  // reported first, since a misspelt option can also make a required one seem missing
    const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& s) { return s[0] == '-'; });
    const std::string& first = option != extras.end() ? *option : extras.front();
    const std::string name = first.substr(0, first.find('='));
    const std::string nearest = Nearest(command, name);
    const std::string message = chosen.empty() && option == extras.end() ? "unknown command " + Quoted(first)
                                : option != extras.end()                 ? "unknown option " + Quoted(name)
                                                                         : "unexpected argument " + Quoted(first);
    return Error(ErrorCode::InvalidUsage, message, {},
                 nearest.empty() ? "see " + page : "did you mean " + Quoted(nearest) + "? see " + page);
  }
  if (chosen.empty()) return Error(ErrorCode::InvalidUsage, "no command was given", {}, "see " + page);
  std::string message = complaint.what();
  const std::string name = message.substr(0, message.find_first_of(": "));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&complaint) != nullptr) {
    message = message.find("missing") != std::string::npos         ? name + " needs a value"
              : message.find("flag override") != std::string::npos ? "--" + name + " takes no value"
                                                                   : name + " is given more than once";
  } else if (dynamic_cast<const CLI::RequiredError*>(&complaint) != nullptr) {
    const std::vector<const CLI::Option*> options = command.get_options();
    const auto missing = std::find_if(options.begin(), options.end(), [](const CLI::Option* option) {
      return option->get_required() && option->count() == 0;
    });
    const std::string what = (*missing)->get_name();
    message = (what == "IN"         ? std::string("the input file")
               : what == "--output" ? std::string("-o FILE")
                                    : what) +
              " is missing";
  }
  return Error(ErrorCode::InvalidUsage, message, {}, "see " + page);
}

}  // namespace facet::cli
