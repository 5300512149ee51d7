// The house stands as its plan says: who may include whom, and what a file may hold.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::set<std::string> kStages = {"vertex", "clip", "bin", "raster", "shade", "blend", "resolve"};

// The one file family that may know OpenImageIO: the module that is opened at run time.
const std::regex kOpenImageIoModule("src/image/oiio[a-z_]*/.*|src/image/[a-z_]*oiio[a-z_]*\\.(cc|h)");

struct Include {
  std::string file;  // relative to the project
  int line = 0;
  std::string target;  // as written
};

const fs::path& Root() {
  static const fs::path root = FACET_SOURCE_DIR;
  return root;
}

std::vector<std::string> ReadLines(const fs::path& path) {
  std::ifstream stream(path);
  EXPECT_TRUE(stream) << path;
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool IsSource(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cc";
}

std::vector<fs::path> FilesUnder(const std::vector<std::string>& folders) {
  std::vector<fs::path> files;
  for (const std::string& folder : folders) {
    if (!fs::exists(Root() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(Root() / folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string Relative(const fs::path& path) { return path.lexically_relative(Root()).generic_string(); }

std::vector<Include> IncludesUnder(const std::vector<std::string>& folders) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const fs::path& path : FilesUnder(folders)) {
    if (!IsSource(path)) continue;
    int number = 0;
    for (const std::string& line : ReadLines(path)) {
      ++number;
      std::smatch match;
      if (std::regex_search(line, match, pattern)) includes.push_back({Relative(path), number, match[1]});
    }
  }
  return includes;
}

std::string FirstPart(std::string_view path) { return std::string(path.substr(0, path.find('/'))); }

// "src/raster/x.cc" -> "raster"; "" outside src/.
std::string RoomOf(const std::string& file) {
  return file.starts_with("src/") ? FirstPart(std::string_view(file).substr(4)) : std::string();
}

// Data flows down the list of rooms in src/CMakeLists.txt; an #include points only up it. The program comes last.
const std::vector<std::string>& Rooms() {
  static const std::vector<std::string> rooms = [] {
    std::string text;
    for (const std::string& line : ReadLines(Root() / "src/CMakeLists.txt")) text += line + " ";
    static const std::regex list(R"(foreach\(room IN ITEMS ([a-z_ ]+)\))");
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, list));
    std::istringstream words(match[1].str() + " cli");
    return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
  }();
  return rooms;
}

int RankOf(const std::string& room) {
  const auto found = std::find(Rooms().begin(), Rooms().end(), room);
  return found == Rooms().end() ? -1 : int(found - Rooms().begin());
}

// The room that a public header belongs to: it says what is known there, and earlier rooms do without it.
const std::map<std::string, std::string> kRoomOfHeader = {
    {"error.h", "base"},        {"version.h", "base"},
    {"digest.h", "base"},       {"shader/arithmetic_check.h", "base"},
    {"image.h", "image"},       {"scene.h", "material"},
    {"settings.h", "material"}, {"load.h", "gltf"},
    {"planes.h", "material"},   {"shader.h", "plan"},
    {"film.h", "film"},         {"render.h", "render"},
    {"compare.h", "compare"},   {"check.h", "check"},
    {"verify.h", "check"},      {"explain.h", "explain"},
    {"report.h", "measure"},    {"facet.h", "cli"},
    {"models.h", "material"},   {"catalog.h", "catalog"},
};
// Those of facet/shader/ are made of lanes; shader-inl.h alone is of all that a user's own shader is made of.
std::string RoomOfHeader(const std::string& target) {
  const auto known = kRoomOfHeader.find(target.substr(std::string_view("facet/").size()));
  if (known != kRoomOfHeader.end()) return known->second;
  if (target == "facet/shader/shader-inl.h") return "shade";
  if (target.starts_with("facet/models/")) return "material";
  return target.starts_with("facet/shader/") ? "simd" : "";
}

// The folder of a library: "codecs" -> "image".
std::string RoomOfLibrary(const std::string& library) {
  static const std::map<std::string, std::string> rooms = [] {
    static const std::regex pattern(R"((?:facet_room|add_library)\((?:facet_)?([a-z_]+))");
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::directory_iterator(Root() / "src")) {
      const fs::path path = entry.path() / "CMakeLists.txt";
      if (!fs::exists(path)) continue;
      for (const std::string& line : ReadLines(path)) {
        std::smatch match;
        if (std::regex_search(line, match, pattern)) found[match[1]] = entry.path().filename().string();
      }
    }
    return found;
  }();
  const auto found = rooms.find(library);
  return found == rooms.end() ? "" : found->second;
}

// Whether an #include names a file of ours: <compare> is none, though there is a room of that name.
bool IsOurs(const std::string& target) { return fs::is_regular_file(Root() / "src" / target); }

bool StartsWithAny(const std::string& text, std::initializer_list<const char*> prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const char* prefix) { return text.starts_with(prefix); });
}

std::string At(const Include& include) {
  return include.file + ":" + std::to_string(include.line) + " includes " + include.target;
}

TEST(Structure, EveryRoomIsInThePlan) {
  for (const auto& entry : fs::directory_iterator(Root() / "src")) {
    if (entry.is_directory()) {
      EXPECT_GE(RankOf(entry.path().filename().string()), 0) << entry.path() << " is not a room of the plan";
    }
  }
}

TEST(Structure, IncludesPointOnlyUpTheList) {
  const auto includes = IncludesUnder({"src"});
  ASSERT_FALSE(includes.empty());
  for (const Include& include : includes) {
    const std::string from = RoomOf(include.file), to = FirstPart(include.target);
    if (RankOf(to) < 0 || !IsOurs(include.target)) continue;
    EXPECT_LE(RankOf(to), RankOf(from)) << At(include);
  }
}

TEST(Structure, PublicHeadersStandInTheSameOrder) {
  for (const Include& include : IncludesUnder({"src", "include"})) {
    if (!include.target.starts_with("facet/")) continue;
    const std::string to = RoomOfHeader(include.target);
    ASSERT_GE(RankOf(to), 0) << include.target << " has no room: add it to kRoomOfHeader";
    const bool is_public = include.file.starts_with("include/");
    const std::string from =
        is_public ? RoomOfHeader(include.file.substr(std::string_view("include/").size())) : RoomOf(include.file);
    EXPECT_LE(RankOf(to), RankOf(from)) << At(include);
  }
}

TEST(Structure, StagesIncludeNoOtherStageAndOnlyRenderKnowsThem) {
  for (const Include& include : IncludesUnder({"src"})) {
    const std::string from = RoomOf(include.file), to = FirstPart(include.target);
    if (!kStages.contains(to) || !IsOurs(include.target)) continue;
    EXPECT_TRUE(from == to || from == "render") << At(include);
  }
}

TEST(Structure, PublicHeadersIncludeNoRoomAndOnlyGlm) {
  static const std::regex standard("[a-z_0-9]+");
  for (const Include& include : IncludesUnder({"include"})) {
    const bool shader = include.file.starts_with("include/facet/shader/");
    // What a user's own shader is compiled with is the renderer's lane code, installed as internal headers.
    if (include.file == "include/facet/shader/shader-inl.h" && include.target.ends_with("-inl.h")) continue;
    const bool allowed = include.target.starts_with("facet/") || include.target.starts_with("glm/") ||
                         std::regex_match(include.target, standard) || (shader && include.target.starts_with("hwy/")) ||
                         // The processor's own intrinsics, where the instruction set is the subject.
                         (shader && include.target == "immintrin.h");
    EXPECT_TRUE(allowed) << At(include);
    if (include.target.starts_with("facet/")) {
      EXPECT_TRUE(fs::exists(Root() / "include" / include.target)) << At(include);
    }
  }
}

TEST(Structure, ThirdPartiesStayInTheirRooms) {
  for (const Include& include : IncludesUnder({"include", "src"})) {
    const std::string& file = include.file;
    const std::string& target = include.target;
    const std::string room = RoomOf(file);
    if (StartsWithAny(target, {"draco/", "meshoptimizer"})) {
      EXPECT_EQ(room, "gltf") << At(include);
    }
    EXPECT_FALSE(target.starts_with("tiny_gltf")) << At(include) << ": for the tests alone";
    if (StartsWithAny(target, {"OpenImageIO/"})) {
      EXPECT_TRUE(std::regex_match(file, kOpenImageIoModule)) << At(include);
    }
    if (StartsWithAny(target, {"tbb/", "oneapi/"})) {
      EXPECT_EQ(room, "base") << At(include);
    }
    if (StartsWithAny(target, {"png.h", "spng.h", "jpeglib.h", "turbojpeg.h"})) {
      EXPECT_EQ(room, "image") << At(include);
    }
    if (StartsWithAny(target, {"CLI/"})) {
      EXPECT_EQ(room, "cli") << At(include);
    }
    if (StartsWithAny(target, {"hwy/"}) && target != "hwy/foreach_target.h") {
      EXPECT_TRUE(room == "simd" || file.starts_with("include/facet/shader/")) << At(include);
    }
  }
}

// Lane templates are compiled once per instruction set: a header that is not a lane header itself would carry them to
// where the compiler's target is another.
TEST(Structure, LaneHeadersAreIncludedBySourcesAndLaneHeadersOnly) {
  for (const Include& include : IncludesUnder({"src", "include"})) {
    if (!include.target.ends_with("-inl.h")) continue;
    EXPECT_TRUE(include.file.ends_with("-inl.h") || include.file.ends_with(".cc") ||
                include.file == "include/facet/shader.h")
        << At(include);
  }
}

// What would be wrong in both could not be found.
TEST(Structure, OraclesShareNothingWithFacet) {
  static const std::regex allowed("[a-z_]+|gtest/gtest\\.h|oracle/[a-z_]+\\.h|facet/(load|render|film)\\.h");
  const auto includes = IncludesUnder({"tests/oracle"});
  ASSERT_FALSE(includes.empty());
  for (const Include& include : includes) EXPECT_TRUE(std::regex_match(include.target, allowed)) << At(include);
}

TEST(Structure, LibrariesDependOnlyOnEarlierRooms) {
  static const std::regex dependency(R"(facet::([a-z_]+))");
  for (const auto& entry : fs::directory_iterator(Root() / "src")) {
    const fs::path path = entry.path() / "CMakeLists.txt";
    const std::string room = entry.path().filename().string();
    if (!fs::exists(path) || room == "cli") continue;  // the program links what it likes
    for (const std::string& with_comment : ReadLines(path)) {
      const std::string line = with_comment.substr(0, with_comment.find('#'));
      for (std::sregex_iterator match(line.begin(), line.end(), dependency), end; match != end; ++match) {
        const std::string library = (*match)[1];
        if (library == "arithmetic") continue;  // flags of the compiler
        const int rank = RankOf(RoomOfLibrary(library));
        ASSERT_GE(rank, 0) << path << ": " << line;
        EXPECT_LE(rank, RankOf(room)) << path << ": " << line;
        EXPECT_FALSE(kStages.contains(room) && kStages.contains((*match)[1]) && (*match)[1] != room)
            << path << ": " << line;
      }
    }
  }
}

TEST(Structure, FilesAreShort) {
  constexpr std::size_t kMaxLines = 500;
  for (const fs::path& path : FilesUnder({"src", "include"})) {
    if (IsSource(path)) {
      EXPECT_LE(ReadLines(path).size(), kMaxLines) << Relative(path);
    }
  }
}

TEST(Structure, FileNamesAreSnakeCase) {
  static const std::regex name(R"([a-z][a-z0-9_]*(-inl\.h|\.h|\.cc))");
  for (const fs::path& path : FilesUnder({"src", "include", "tests", "bench", "assets", "docs"})) {
    if (IsSource(path)) {
      EXPECT_TRUE(std::regex_match(path.filename().string(), name)) << Relative(path);
    }
  }
}

// The bits of a picture depend on the compiler's promise to keep to IEEE 754, and one object file's instruction set
// must not leak into another's inline functions.
TEST(Structure, NoFastMathAndNoInstructionSetFlags) {
  static const std::regex forbidden(
      R"((^|[^o])-ffast-math|-Ofast|-march=|-mcpu=|-mtune=|-m(avx|sse|fma|bmi|f16c)|-ffp-contract=(fast|on)|-fassociative|-freciprocal|-funsafe-math)");
  std::vector<fs::path> files = FilesUnder({"src", "tests", "bench", "assets", "cmake", "docs", "scripts", ".ci"});
  files.push_back(Root() / "CMakeLists.txt");
  files.push_back(Root() / "CMakePresets.json");
  for (const fs::path& path : files) {
    const std::string name = path.filename().string();
    const bool build = name == "CMakeLists.txt" || name == "CMakePresets.json" || path.extension() == ".cmake" ||
                       path.extension() == ".in" || path.extension() == ".sh" || name == "run";
    if (!build) continue;
    for (const std::string& line : ReadLines(path)) {
      const std::string code = line.substr(0, line.find('#'));
      EXPECT_FALSE(std::regex_search(code, forbidden)) << Relative(path) << ": " << line;
    }
  }
}

// Rendering rooms call no function of the C library whose last bit differs between machines.
TEST(Structure, RenderingUsesNoTranscendentalsOfTheCLibrary) {
  static const std::regex forbidden(
      R"(\bstd::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|erf|tgamma|lgamma)f?\s*\(|\bglm::(sin|cos|tan|asin|acos|atan|exp|exp2|log|log2|pow|rotate|angleAxis|slerp|perspective|perspectiveFov|infinitePerspective|inversesqrt|mix_slerp)\s*[(<])");
  const std::set<std::string> outside = {"image", "gltf",    "reference", "settings", "compare",
                                         "check", "explain", "measure",   "cli"};  // codecs, parsing, oracles
  for (const fs::path& path : FilesUnder({"src", "include"})) {
    if (!IsSource(path) || outside.contains(RoomOf(Relative(path)))) continue;
    int number = 0;
    for (const std::string& line : ReadLines(path)) {
      ++number;
      const std::string code = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(code, forbidden)) << Relative(path) << ":" << number << ": " << line;
    }
  }
}

// What looks like a path of the project in `code` or [a link](target) of the documentation is one.
TEST(Structure, PathsInTheDocumentationExist) {
  static const std::regex quoted(R"(`([^`\s]+)`)");
  static const std::regex link(R"(\]\(([^)#\s]+)(#[^)]*)?\))");
  static const std::regex in_tree(
      R"((\.ci|\.clang-format|\.clang-tidy|assets|bench|cmake|docs|include|scripts|src|tests|CMakeLists\.txt|CMakePresets\.json|LICENSE|README\.md)(/[A-Za-z0-9_.*/+-]*)?)");
  std::vector<fs::path> documents = {Root() / "README.md"};
  for (const fs::path& path : FilesUnder({"docs"})) {
    if (path.extension() == ".md") documents.push_back(path);
  }
  int checked = 0;
  for (const fs::path& document : documents) {
    for (const std::string& line : ReadLines(document)) {
      for (std::sregex_iterator match(line.begin(), line.end(), quoted), end; match != end; ++match) {
        const std::string text = (*match)[1];
        if (!std::regex_match(text, in_tree) || text.find('*') != std::string::npos) continue;
        EXPECT_TRUE(fs::exists(Root() / text)) << Relative(document) << " names " << text;
        ++checked;
      }
      for (std::sregex_iterator match(line.begin(), line.end(), link), end; match != end; ++match) {
        const std::string text = (*match)[1];
        if (text.find("://") != std::string::npos) continue;
        EXPECT_TRUE(fs::exists(document.parent_path() / text)) << Relative(document) << " links to " << text;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 0);
}

// What the documentation shows of an example is the example.
TEST(Structure, ExamplesInTheDocumentationAreTheFilesThatAreTested) {
  const auto read = [](const fs::path& path) {
    std::ifstream stream(path);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  };
  const std::string page = read(Root() / "docs/library.md");
  int examples = 0;
  for (const fs::path& path : FilesUnder({"docs/examples"})) {
    if (!IsSource(path)) continue;
    EXPECT_NE(page.find("```cpp\n" + read(path) + "```"), std::string::npos) << Relative(path);
    EXPECT_TRUE(fs::exists(Root() / "tests/examples/CMakeLists.txt"));
    const std::string tests = read(Root() / "tests/examples/CMakeLists.txt");
    EXPECT_NE(tests.find(path.stem().string()), std::string::npos) << Relative(path) << " is not run";
    ++examples;
  }
  EXPECT_GE(examples, 1);
}

}  // namespace
