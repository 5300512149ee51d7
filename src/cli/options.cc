#include "cli/options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <numbers>
#include <vector>

#include "cli/console.h"
#include "cli/parse.h"
#include "facet/error.h"
#include "facet/version.h"

namespace facet::cli {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  success                       5  something required is not supported\n"
    "  1  a defect of facet             6  the output could not be written\n"
    "  2  wrong usage                   7  out of memory\n"
    "  3  the input cannot be read      8  OpenImageIO is needed and not installed\n"
    "  4  the input is not valid";

constexpr const char* kRenderExamples =
    "Examples:\n"
    "  facet render helmet.glb -o helmet.png\n"
    "  facet render car.gltf -o car.png --size 1920x1080 --orbit 35,80 --background white\n"
    "  facet render room.glb -o room.exr --camera Kitchen --environment sky.hdr\n"
    "  facet render fox.glb -o run.png --animation Run --time 0.4 --stats=json > run.json\n";

// CLI11's own page, less its blank lines, with a usage line that shows the required option too.
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

// An option that takes one text and hands it to `use`.
template <class Use>
CLI::Option* Add(CLI::App& app, const std::string& group, const std::string& name, const std::string& value,
                 const std::string& description, Use use) {
  return app.add_option_function<std::string>(name, use, description)
      ->group(group)
      ->option_text(value)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

// What the camera's options say before they are put together.
struct CameraOptions {
  std::optional<Orbit> orbit;
  std::optional<glm::dvec3> target;
  std::optional<double> fov_degrees;
};

void AddInputAndOutput(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "IN", [&](const std::string& text) { options.input = text; }, "The scene: a .gltf or .glb file")
      ->required()
      ->option_text(" ");
  const std::string group = "Output";
  Add(app, group, "-o,--output", "FILE", "Picture: .png, .exr, .hdr, .tif, .jpg, .webp ...",
      [&](const std::string& text) { options.output = text; })
      ->required();
  Add(app, group, "--size", "WxH", "Pixels, each side 1 to 16384 [1024x1024]", [&](const std::string& text) {
    const Size size = ParseSize("--size", text);
    options.settings.width = size.width;
    options.settings.height = size.height;
  });
  Add(app, group, "--bits", "8|16", "Bits a channel of PNG and TIFF [8]", [&](const std::string& text) {
    options.type = ParseChoice("--bits", text, {"8", "16"}) == 0 ? ChannelType::U8 : ChannelType::U16;
  });
  Add(app, group, "--exposure", "EV", "Multiply light by 2^EV, -64 to 64 [0]", [&](const std::string& text) {
    options.display.exposure_ev = ParseNumber("--exposure", text, {-64.0, 64.0});
  });
  Add(app, group, "--tonemap", "CURVE", "none, reinhard, aces, agx or neutral [neutral]", [&](const std::string& text) {
    options.display.tone_map =
        static_cast<ToneMap>(ParseChoice("--tonemap", text, {"none", "reinhard", "aces", "agx", "neutral"}));
    options.tone_map_given = true;
  });
  Add(app, group, "--background", "WHAT", "#rgb, #rrggbb, a colour's name, transparent,\nor environment [transparent]",
      [&](const std::string& text) {
        options.background_given = true;
        if (text == "environment") {
          options.settings.background = Background::Environment;
        } else if (text != "transparent") {
          options.display.background_srgb = ParseColor("--background", text);
        }
      });
}

void AddView(CLI::App& app, RenderOptions& options, CameraOptions& camera) {
  const std::string group = "Camera";
  CLI::Option* by_name = Add(app, group, "--camera", "NAME|INDEX", "A camera of the file [framed from the bounds]",
                             [&](const std::string& text) { options.camera = text; });
  CLI::Option* orbit = Add(app, group, "--orbit", "THETA,PHI[,RADIUS]",
                           "Degrees about +Y, degrees from +Y, and distance\n[the distance that frames the scene]",
                           [&](const std::string& text) { camera.orbit = ParseOrbit("--orbit", text); });
  CLI::Option* target = Add(app, group, "--target", "X,Y,Z", "What the orbit turns about [centre of the bounds]",
                            [&](const std::string& text) { camera.target = ParseVec3("--target", text); });
  CLI::Option* fov =
      Add(app, group, "--fov", "DEG", "Vertical field of view, 1 to 179 [45]", [&](const std::string& text) {
        camera.fov_degrees = ParseNumber("--fov", text, {1.0, 179.0});
      });
  for (CLI::Option* other : {orbit, target, fov}) by_name->excludes(other);
}

void AddScene(CLI::App& app, RenderOptions& options) {
  const std::string group = "Scene";
  Add(app, group, "--scene", "NAME|INDEX", "A scene of the file [its default one]",
      [&](const std::string& text) { options.scene = text; });
  Add(app, group, "--animation", "NAME|INDEX", "Pose by an animation [rest pose; the first one\nif --time is given]",
      [&](const std::string& text) { options.animation = text; });
  Add(app, group, "--time", "SECONDS", "Moment of the animation [0]", [&](const std::string& text) {
    options.settings.time = ParseNumber("--time", text, {0.0, 1e9});
    options.time_given = true;
  });
  Add(app, group, "--variant", "NAME|INDEX", "A material variant of the file [none]",
      [&](const std::string& text) { options.variant = text; });
  app.add_flag("--ignore-required-extensions", options.load.ignore_required_extensions,
               "Render in spite of extensions that the file\nrequires and facet does not have")
      ->group(group)
      ->disable_flag_override();
}

void AddLight(CLI::App& app, RenderOptions& options) {
  const std::string group = "Light";
  Add(app, group, "--environment", "FILE|none", "Equirectangular picture that lights the scene\n[a built-in studio]",
      [&](const std::string& text) {
        EnvironmentSettings& environment = options.settings.environment;
        if (text == "none") {
          environment.kind = EnvironmentSettings::Kind::None;
        } else if (text != "studio") {
          environment.kind = EnvironmentSettings::Kind::Image;
          options.environment = text;
        }
      });
  Add(app, group, "--environment-rotation", "DEG", "Counter-clockwise seen from above [0]",
      [&](const std::string& text) {
        options.settings.environment.rotation =
            ParseNumber("--environment-rotation", text, {-36000.0, 36000.0}) * kRadiansPerDegree;
      });
  Add(app, group, "--environment-intensity", "F", "Factor of its light, 0 to 1e6 [1]", [&](const std::string& text) {
    options.settings.environment.intensity = ParseNumber("--environment-intensity", text, {0.0, 1e6});
  });
}

void AddQuality(CLI::App& app, RenderOptions& options) {
  const std::string group = "Quality and speed";
  Add(app, group, "--samples", "1|2|4|8", "Coverage samples a pixel [4]", [&](const std::string& text) {
    options.settings.samples = 1 << ParseChoice("--samples", text, {"1", "2", "4", "8"});
  });
  Add(app, group, "--max-anisotropy", "N", "Texture samples along a stretched footprint,\n1 to 16 [8]",
      [&](const std::string& text) {
        options.settings.max_anisotropy = ParseInteger("--max-anisotropy", text, 1, 16);
      });
  Add(app, group, "--threads", "N", "0 to 1024; 0 is one a core; never changes the\npicture [0]",
      [&](const std::string& text) { options.settings.threads = ParseInteger("--threads", text, 0, 1024); });
}

void AddMessages(CLI::App& app, RenderOptions& options) {
  const std::string group = "Messages";
  const std::string stats_description =
      "Times and counts of each stage on standard error;\n--stats=json: as JSON on standard output";
  CLI::Option* stats = app.add_flag<const std::string>("--stats{table}", stats_description);
  stats->group(group)->each([&](const std::string& text) {
    if (ParseChoice("--stats", text, {"table", "json"}) == 0) {
      options.stats_table = true;
    } else {
      options.stats_json = "-";
    }
  });
  Add(app, group, "--stats-json", "FILE|-", "The same as JSON into a file",
      [&](const std::string& text) { options.stats_json = text; });
  app.add_flag_callback(
         "--progress", [&] { options.progress = true; },
         "Report progress even when standard error is\n"
         "no terminal")
      ->group(group)
      ->disable_flag_override();
  app.add_flag_callback(
         "--no-progress", [&] { options.progress = false; }, "Never report progress")
      ->group(group)
      ->disable_flag_override();
  app.add_flag("-q,--quiet", options.quiet, "No warnings and no progress; errors only")
      ->group(group)
      ->disable_flag_override();
}

void PlaceCamera(const CameraOptions& given, RenderSettings& settings) {
  std::optional<double> yfov;
  if (given.fov_degrees) yfov = *given.fov_degrees * kRadiansPerDegree;
  if (!given.orbit && !given.target) {
    settings.camera = AutoCamera{yfov};
    return;
  }
  OrbitCamera orbit;
  if (given.orbit) {
    orbit.theta = given.orbit->theta_degrees * kRadiansPerDegree;
    orbit.phi = given.orbit->phi_degrees * kRadiansPerDegree;
    orbit.radius = given.orbit->radius;
  }
  orbit.target = given.target;
  orbit.yfov = yfov;
  settings.camera = orbit;
}

// Levenshtein's distance, for "did you mean".
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

// The option or command of `app` that `text` is most likely meant to be; empty when none is near.
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

// CLI11's complaint as ours.
Error UsageError(const CLI::App& app, const CLI::ParseError& complaint) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string page = chosen.empty() ? "'facet --help'" : "'facet " + command.get_name() + " --help'";
  std::vector<std::string> extras = app.remaining(true);
  extras.erase(std::remove(extras.begin(), extras.end(), "--"), extras.end());
  if (!extras.empty()) {  // a misspelt option also makes others look missing: it comes first
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
  } else if (dynamic_cast<const CLI::ExcludesError*>(&complaint) != nullptr) {
    message = name + " cannot go together with " + message.substr(message.rfind(' ') + 1);
  }
  if (command.get_option("IN")->count() == 0)
    message = "the input file is missing";
  else if (dynamic_cast<const CLI::RequiredError*>(&complaint) != nullptr)
    message = "-o FILE is missing";
  return Error(ErrorCode::InvalidUsage, message, {}, "see " + page);
}

}  // namespace

Command ParseCommandLine(int argc, const char* const* argv) {
  CLI::App app("facet renders glTF 2.0 scenes on the CPU: the same picture, to the last bit, on every machine.",
               "facet");
  app.formatter(std::make_shared<Page>("facet COMMAND [OPTIONS]"));
  app.set_help_flag("-h,--help", "This page, or a command's: facet render --help");
  app.set_version_flag("--version", std::string("facet ") + Version(), "The version of facet");
  app.footer(std::string(kRenderExamples) + "  facet info helmet.glb\n\n" + kExitCodes);
  app.require_subcommand(1);

  RenderOptions render;
  CameraOptions camera;
  CLI::App& render_app = *app.add_subcommand("render", "Draw a scene into a picture")->group("Commands");
  render_app.formatter(std::make_shared<Page>("facet render IN -o OUT [OPTIONS]"));
  render_app.set_help_flag("");
  render_app.footer(std::string("A value in brackets is the default.\n\n") + kRenderExamples + "\n" + kExitCodes);
  AddInputAndOutput(render_app, render);
  AddView(render_app, render, camera);
  AddScene(render_app, render);
  AddLight(render_app, render);
  AddQuality(render_app, render);
  AddMessages(render_app, render);
  render_app.set_help_flag("-h,--help", "This page")->group("Messages");  // last on its page

  InfoOptions info;
  CLI::App& info_app =
      *app.add_subcommand("info", "Say what is in a file and what facet makes of it")->group("Commands");
  info_app.formatter(std::make_shared<Page>("facet info IN [--json]"));
  info_app.set_help_flag("-h,--help", "This page");
  info_app.footer(kExitCodes);
  info_app
      .add_option_function<std::string>(
          "IN", [&](const std::string& text) { info.input = text; }, "The scene: a .gltf or .glb file")
      ->required()
      ->option_text(" ");
  info_app.add_flag("--json", info.json, "As JSON with stable keys")->disable_flag_override();

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    return TextRequest{(chosen.empty() ? app : *chosen.front()).help()};
  } catch (const CLI::CallForVersion& version) {
    return TextRequest{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& complaint) {
    throw UsageError(app, complaint);
  }
  if (info_app.parsed()) return info;
  PlaceCamera(camera, render.settings);
  return render;
}

}  // namespace facet::cli
