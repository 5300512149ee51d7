#include "facet/check.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <new>
#include <regex>
#include <utility>

#include "base/input_file.h"
#include "base/memory_budget.h"
#include "base/number_text.h"
#include "base/output_file.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "check/manifest.h"
#include "facet/error.h"
#include "facet/film.h"
#include "facet/render.h"
#include "facet/version.h"
#include "image/codec.h"
#include "settings/provenance.h"

namespace facet {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Converts an error of the loader to one that names its position in the manifest.
Error Placed(const Manifest& manifest, const ManifestEntry& entry, const Error& error) {
  const std::string& where = error.where();
  const auto at = [&](const std::string& pointer, const std::string& message) {
    return Error(error.code(), message, PlaceIn(manifest, pointer), error.hint());
  };
  if (where.empty()) return at(entry.pointer, error.message());
  if (where.starts_with("--")) {
    return at(SettingPointer(entry, where.substr(2, where.find(' ') - 2)), error.message());
  }
  const auto is_of = [&](const std::optional<std::filesystem::path>& file) {
    return file && where.starts_with((manifest.path.parent_path() / *file).string());
  };
  const std::string pointer = is_of(entry.request.environment) ? SettingPointer(entry, "environment")
                              : is_of(entry.request.materials) ? SettingPointer(entry, "materials")
                                                               : entry.pointer + "/scene";
  return at(pointer, where + ": " + error.message());
}

// A golden image: the bytes of its file, and the decoded image.
struct Golden {
  Bytes file;
  Image image;
};

Golden LoadGolden(const std::filesystem::path& path) {
  Golden golden;
  golden.file = ReadFile(path, {.regular_only = true});
  golden.image = DecodeImage(golden.file.Span(), Printable(path.string()));
  if (golden.image.type == ChannelType::F32) {
    throw Error(ErrorCode::InvalidInput, "is no PNG", Printable(path.string()));
  }
  return golden;
}

std::string SizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

std::string Short(const Digest& digest) { return ToHex(digest).substr(0, 12); }

std::string Summary(const ImageDifference& d) {
  if (d.equal) return "the picture is equal";
  return "FLIP " + ShortNumber(d.flip_mean) + ", RMSE " + ShortNumber(d.rmse) + ", largest difference " +
         ShortNumber(d.max_difference) + " at (" + std::to_string(d.max_x) + ", " + std::to_string(d.max_y) + "), " +
         std::to_string(d.differing_pixels) + " of " + std::to_string(std::size_t(d.width) * std::size_t(d.height)) +
         " pixels differ";
}

ExpectedInputs HashInputs(const RenderInputs& inputs) {
  const SceneDigests scene = HashScene(inputs.loaded.scene);
  return {scene.description, scene.geometry, scene.textures, HashEnvironment(inputs.settings.environment)};
}

// Says whether the inputs differ, and which, or else the settings or the renderer.
std::string Blame(const ExpectedInputs& expected, const ExpectedInputs& actual) {
  std::vector<std::string> differ;
  if (expected.description != actual.description) differ.push_back("description");
  if (expected.geometry != actual.geometry) differ.push_back("geometry");
  if (expected.textures != actual.textures) differ.push_back("textures");
  if (expected.environment != actual.environment) differ.push_back("environment");
  if (differ.empty()) return "the inputs are the same: the settings or the renderer differ";
  return "the inputs differ: " + Joined(differ) + " (another file, or another version of its decoder?)";
}

// Checks one entry of the manifest.
class Check {
 public:
  // `pictures`: the memory budget of the images that all entries keep for the report.
  // `inputs`: the input files of all entries, which must not be overwritten.
  Check(const Manifest& manifest, std::size_t index, const CheckOptions& options, int threads, MemoryBudget& pictures,
        const FileSet& inputs)
      : manifest_(manifest),
        entry_(manifest.entries[index]),
        expect_(entry_.expect),
        index_(index),
        options_(options),
        threads_(threads),
        pictures_(pictures),
        inputs_(inputs) {}

  // Returns the result, and the new expectation for the manifest if the entry is updated.
  std::pair<CheckedEntry, std::optional<NewExpectation>> Run() {
    const Clock::time_point start = Clock::now();
    MemoryBudget budget(options_.load.memory_limit);  // for work other than loading and rendering
    const MemoryBudget::Scope scope(budget);
    result_.name = entry_.name;
    result_.place = PlaceIn(manifest_, entry_.pointer);
    result_.expected_film = expect_.film;
    const std::filesystem::path folder = manifest_.path.parent_path();
    result_.files.push_back(folder / entry_.scene);
    if (entry_.request.environment) result_.files.push_back(folder / *entry_.request.environment);
    if (entry_.request.materials) result_.files.push_back(folder / *entry_.request.materials);
    if (expect_.picture) result_.files.push_back(folder / *expect_.picture);
    try {
      if (entry_.problem) throw Error(*entry_.problem);
      Decide();
    } catch (const Error& error) {
      out_of_memory_ = error.code() == ErrorCode::OutOfMemory;
      const bool placed = error.where().starts_with(manifest_.name);
      if (placed) result_.place = error.where();
      SetError(placed ? std::string(error.what()).substr(error.where().size() + 2) : error.what());
    } catch (const std::bad_alloc&) {
      out_of_memory_ = true;
      SetError("the machine has too little memory; fewer threads need less");
    } catch (const std::exception& error) {
      SetError(std::string("a defect of facet: ") + error.what());
    }
    if (options_.strict && !result_.warnings.empty() &&
        (result_.verdict == Verdict::Passed || result_.verdict == Verdict::Within)) {
      result_.verdict = Verdict::Failed;
      result_.message = "has a warning, and all count as failures: " + Printable(result_.warnings.front()) +
                        (result_.message.empty() ? "" : "; ") + result_.message;
    }
    result_.seconds = SecondsSince(start);
    return {std::move(result_), std::move(update_)};
  }

  bool out_of_memory() const { return out_of_memory_; }

 private:
  void SetError(const std::string& message) {
    result_.verdict = Verdict::Error;
    result_.message = Printable(message);
    update_.reset();
  }

  void Decide() {
    const RenderInputs inputs = Load();
    const std::vector<std::filesystem::path>& of_scene = inputs.loaded.report.files;
    result_.files.insert(result_.files.end(), of_scene.begin(), of_scene.end());
    RenderSettings settings = inputs.settings;
    settings.threads = threads_;
    RenderStats stats;
    Film film = Render(inputs.loaded.scene, settings, &stats);
    result_.warnings = inputs.loaded.report.warnings;
    result_.warnings.insert(result_.warnings.end(), stats.warnings.begin(), stats.warnings.end());
    result_.film = HashFilm(film);
    const bool same_film = expect_.film == result_.film;
    if (same_film && !expect_.picture) {
      result_.verdict = Verdict::Passed;
      return;
    }
    const Image actual = EncodeFilm(film, entry_.request.display, entry_.request.type);
    film = {};
    const std::optional<Golden> golden = FindGolden();
    if (golden && actual.width == golden->image.width && actual.height == golden->image.height) {
      result_.difference = CompareImages(golden->image, actual, {.memory_limit = options_.load.memory_limit});
    } else if (golden) {
      other_size_ = "the golden picture is " + SizeText(golden->image.width, golden->image.height) +
                    ", the rendering " + SizeText(actual.width, actual.height) +
                    ": the setting 'size', or --update, makes them one";
    }
    if (same_film) {
      JudgePicture();
    } else {
      Judge();
    }
    if (result_.verdict != Verdict::Passed) {
      if (options_.pictures) KeepPictures(golden, actual);
      Settle(actual, inputs, same_film);
    }
    if (result_.difference) result_.difference->flip_map = {};
  }

  RenderInputs Load() const {
    try {
      const std::filesystem::path& root = options_.load.root;
      return LoadInputs(DataPath(manifest_.path, entry_.scene, root), entry_.request, options_.load,
                        {manifest_.path, root});
    } catch (const Error& error) {
      throw Placed(manifest_, entry_, error);
    }
  }

  // None if the entry lists no golden image, or if it cannot be read and will be replaced anyway.
  std::optional<Golden> FindGolden() const {
    if (!expect_.picture) return std::nullopt;
    const std::filesystem::path path = PicturePath();
    try {
      return LoadGolden(path);
    } catch (const Error& error) {
      if (options_.update) return std::nullopt;
      const std::string hint = error.hint().empty() ? "--update writes it anew" : error.hint();
      throw Error(error.code(), error.where() + ": " + error.message(), PicturePlace(), hint);
    }
  }

  std::string PicturePlace() const { return PlaceIn(manifest_, entry_.pointer + "/expect/picture"); }

  std::filesystem::path PicturePath() const {
    try {
      return DataPath(manifest_.path, *expect_.picture, options_.load.root);
    } catch (const Error& error) {
      throw Error(error.code(), error.message(), PicturePlace(), error.hint());
    }
  }

  // Sets the verdict if the film is equal to the expected one: then only the encoded image can differ.
  void JudgePicture() {
    const std::optional<ImageDifference>& difference = result_.difference;
    const bool within =
        difference && expect_.has_thresholds && BrokenThresholds(*difference, expect_.thresholds).empty();
    result_.verdict = within || (difference && difference->equal) ? Verdict::Passed : Verdict::Failed;
    if (result_.verdict == Verdict::Failed) {
      result_.message =
          difference ? "the film is equal, the encoded image is not: " + Summary(*difference) : other_size_;
    }
  }

  // Sets the verdict if the film differs from the expected one, or none is expected.
  void Judge() {
    const std::optional<ImageDifference>& difference = result_.difference;
    result_.verdict = Verdict::Failed;
    if (!difference) {
      result_.message = !other_size_.empty() ? other_size_
                        : expect_.film       ? "the film differs"
                        : expect_.picture    ? "there is no golden picture"  // to be updated
                                             : "has no expectation; run with --update";
      return;
    }
    const bool by_picture = !expect_.film || expect_.has_thresholds;
    const std::vector<std::string> broken = BrokenThresholds(*difference, expect_.thresholds);
    if (by_picture && broken.empty()) {
      result_.verdict = difference->equal && !expect_.film ? Verdict::Passed : Verdict::Within;
    }
    const std::string film = expect_.film ? "the film differs; " : "";
    if (result_.verdict == Verdict::Within) {
      result_.message = film + "within thresholds: " + Summary(*difference);
    } else if (result_.verdict == Verdict::Failed) {
      result_.message = film + (expect_.has_thresholds ? Joined(broken) : Summary(*difference));
    } else {
      result_.message = Summary(*difference);
    }
  }

  // Adds the cause of the difference to the message and, with --update, replaces the expectation by the result.
  void Settle(const Image& actual, const RenderInputs& inputs, bool same_film) {
    const bool update = options_.update && (expect_.film || result_.verdict == Verdict::Failed);
    std::vector<std::string> done;
    if (!same_film && (update || expect_.inputs)) {
      const ExpectedInputs now = HashInputs(inputs);
      if (expect_.inputs) result_.message += "; " + Blame(*expect_.inputs, now);
      if (update) {
        update_ = NewExpectation{index_, *result_.film, now};
        done.push_back(expect_.film ? "film " + Short(*expect_.film) + " is now " + Short(*result_.film)
                                    : "film " + Short(*result_.film) + " recorded");
      }
    }
    if (!update) return;
    if (expect_.picture && !(result_.difference && result_.difference->equal)) {
      WritePicture(actual, inputs.loaded.report.files);
      done.push_back("picture written");
    }
    const bool was_there = expect_.film || result_.difference;
    result_.verdict = Verdict::Updated;
    result_.message = Joined(done) + (was_there && !same_film ? "; " + result_.message : "");
  }

  void WritePicture(const Image& actual, const std::vector<std::filesystem::path>& scene_files) const {
    const std::filesystem::path path = PicturePath();
    RefuseOverwritingAnyOf(inputs_, {path});
    RefuseOverwriting({path}, scene_files);
    std::error_code ignored;  // writing the file reports a better error
    std::filesystem::create_directories(path.parent_path(), ignored);
    const Provenance provenance{Version(), entry_.scene.filename().string(), SpelledOut(entry_.request), *result_.film,
                                HashImage(actual)};
    WriteFile(path, EncodePng(actual, ToImageText(provenance)), OutputFile::Links::Refuse);
  }

  void KeepPictures(const std::optional<Golden>& golden, const Image& actual) {
    result_.actual = EncodePng(actual);
    if (golden) result_.expected.assign(golden->file.data, golden->file.data + golden->file.size);
    if (result_.difference) result_.heat_map = EncodePng(HeatMap(*result_.difference));
    try {
      pictures_.Charge(result_.actual.size() + result_.expected.size() + result_.heat_map.size(), 1, "pictures");
    } catch (const Error&) {
      result_.actual = result_.expected = result_.heat_map = {};
      result_.warnings.push_back("its pictures are not kept: those of earlier entries have reached the memory limit");
    }
  }

  const Manifest& manifest_;
  const ManifestEntry& entry_;
  const Expectation& expect_;
  const std::size_t index_;
  const CheckOptions& options_;
  const int threads_;
  MemoryBudget& pictures_;
  const FileSet& inputs_;
  bool out_of_memory_ = false;
  std::string other_size_;  // the message if the golden image has another size than the rendering
  CheckedEntry result_;
  std::optional<NewExpectation> update_;
};

std::vector<std::size_t> Selected(const Manifest& manifest, const std::string& only) {
  std::vector<std::size_t> selected;
  try {
    const std::regex pattern(only);
    for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
      if (std::regex_search(manifest.entries[i].name, pattern)) selected.push_back(i);
    }
  } catch (const std::regex_error&) {
    throw Error(ErrorCode::InvalidUsage, Quoted(only) + " is no regular expression", "--only");
  }
  if (selected.empty() && !only.empty()) {
    throw Error(ErrorCode::InvalidUsage, "no entry of " + manifest.name + " is called like " + Quoted(only), "--only");
  }
  return selected;
}

// The input files of all entries, which no update may overwrite.
FileSet InputsOf(const Manifest& manifest) {
  FileSet files;
  files.Add(manifest.path);
  const std::filesystem::path folder = manifest.path.parent_path();
  for (const ManifestEntry& entry : manifest.entries) {
    files.Add(folder / entry.scene);
    if (entry.request.environment) files.Add(folder / *entry.request.environment);
    if (entry.request.materials) files.Add(folder / *entry.request.materials);
  }
  return files;
}

}  // namespace

const char* NameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::Passed: return "passed";
    case Verdict::Within: return "within";
    case Verdict::Updated: return "updated";
    case Verdict::Failed: return "failed";
    case Verdict::Error: break;
  }
  return "error";
}

std::size_t CheckReport::Count(Verdict verdict) const {
  return static_cast<std::size_t>(
      std::count_if(entries.begin(), entries.end(), [&](const CheckedEntry& e) { return e.verdict == verdict; }));
}

CheckReport CheckManifest(const std::filesystem::path& path, const CheckOptions& options) {
  const Clock::time_point start = Clock::now();
  CheckThreads(options.threads);
  MemoryBudget whole(options.load.memory_limit);  // for the manifest and the report
  const MemoryBudget::Scope scope(whole);
  const Manifest manifest = ReadManifest(path);
  CheckReport report;
  report.manifest = manifest.name;
  for (const Error& problem : manifest.problems) report.problems.push_back(problem.what());

  const std::vector<std::size_t> selected = Selected(manifest, options.only);
  report.entries.resize(selected.size());
  std::vector<std::optional<NewExpectation>> updates(selected.size());
  // By default, threads that finish an entry help with others. With --threads, each entry has a fixed number of them.
  const int most = static_cast<int>(std::min<std::size_t>(selected.size(), 16384));
  const int beside = options.threads == 0 ? 0 : std::max(1, std::min(options.threads, most));
  const int each = options.threads == 0 ? 0 : options.threads / beside;
  MemoryBudget pictures(options.load.memory_limit);
  const FileSet inputs = InputsOf(manifest);
  std::vector<std::uint8_t> refused(selected.size());
  const auto run = [&](std::size_t i, const CheckOptions& limited) {
    Check check(manifest, selected[i], limited, each, pictures, inputs);
    std::tie(report.entries[i], updates[i]) = check.Run();
    refused[i] = check.out_of_memory();
  };
  RunWithThreads(beside, [&] {
    CheckOptions share = options;
    share.load.memory_limit = pictures.limit() / std::min<std::uint64_t>(CurrentThreadCount(), selected.size());
    ParallelFor(selected.size(), 1, [&](std::size_t i, std::size_t) { run(i, share); });
    // Entries that ran out of memory run again, alone with the whole limit: results do not depend on threads.
    for (std::size_t i = 0; i < selected.size(); ++i) {
      if (refused[i]) run(i, options);
    }
  });

  std::vector<NewExpectation> expectations;
  for (const std::optional<NewExpectation>& update : updates) {
    if (update) expectations.push_back(*update);
  }
  if (!expectations.empty()) {
    const std::string text = Rewritten(manifest, expectations);
    WriteFile(path, text);
  }
  report.seconds = SecondsSince(start);
  return report;
}

}  // namespace facet
