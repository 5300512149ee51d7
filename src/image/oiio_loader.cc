#include "image/oiio_loader.h"

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>

#include "facet/error.h"
#include "image/codec.h"
#include "image/formats.h"
#include "image/limits.h"
#include "image/oiio_abi.h"

namespace facet {
namespace {

namespace fs = std::filesystem;

constexpr char kFileName[] = "facet_oiio.so";
constexpr std::size_t kMessageSize = 512;

struct Module {
  FacetOiioDecode decode = nullptr;
  FacetOiioEncode encode = nullptr;
  FacetOiioFree free = nullptr;
};

std::mutex mutex;
std::optional<Module> opened;                            // guarded by mutex; never closed
const std::vector<fs::path>* search_override = nullptr;  // guarded by mutex

template <class Function>
bool Find(void* library, const char* name, Function* function) {
  *function = reinterpret_cast<Function>(dlsym(library, name));
  return *function != nullptr;
}

Module Open(const std::vector<fs::path>& candidates) {
  std::string trouble;  // of a module that exists but cannot be opened, the most useful error
  for (const fs::path& path : candidates) {
    std::error_code ignored;
    if (path.has_parent_path() && !fs::exists(path, ignored)) continue;
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      const char* why = dlerror();
      if (path.has_parent_path() && trouble.empty()) trouble = why ? why : "dlopen failed";
      continue;
    }
    Module module;
    FacetOiioAbiVersion version = nullptr;
    if (Find(library, "FacetOiioAbiVersion_", &version) && version() == FACET_OIIO_ABI_VERSION &&
        Find(library, "FacetOiioDecode_", &module.decode) && Find(library, "FacetOiioEncode_", &module.encode) &&
        Find(library, "FacetOiioFree_", &module.free)) {
      return module;
    }
    dlclose(library);
    if (trouble.empty()) trouble = path.string() + " belongs to another version of facet";
  }
  for (char& c : trouble) {
    if (c == '\n') c = ' ';
  }
  const std::string state = trouble.empty() ? " is not installed" : " does not open: " + trouble;
  throw Error(ErrorCode::MissingModule, std::string("the module ") + kFileName + state, {},
              std::string("build facet with OpenImageIO, or set FACET_MODULE_PATH to the folder of ") + kFileName);
}

Module Get() {
  const std::lock_guard lock(mutex);
  if (search_override) {
    std::vector<fs::path> candidates;
    for (const fs::path& folder : *search_override) candidates.push_back(folder / kFileName);
    return Open(candidates);
  }
  if (!opened) opened = Open(OiioModuleCandidates());
  return *opened;
}

// The same error, with the name of the image that needed the module.
Module GetFor(const std::string& name, const std::string& need) {
  try {
    return Get();
  } catch (const Error& error) {
    throw Error(error.code(), need + error.message(), name, error.hint());
  }
}

ErrorCode CodeOf(int result) {
  switch (result) {
    case FACET_OIIO_INVALID_INPUT: return ErrorCode::InvalidInput;
    case FACET_OIIO_TOO_LARGE: return ErrorCode::OutOfMemory;
    case FACET_OIIO_OUTPUT_FAILED: return ErrorCode::OutputFailed;
    case FACET_OIIO_UNSUPPORTED: return ErrorCode::Unsupported;
    default: return ErrorCode::Internal;
  }
}

}  // namespace

std::vector<fs::path> OiioModuleCandidates() {
  std::vector<fs::path> out;
  if (const char* variable = std::getenv("FACET_MODULE_PATH")) {
    const std::string folders = variable;
    for (std::size_t at = 0; at <= folders.size();) {
      const std::size_t end = std::min(folders.find(':', at), folders.size());
      if (end > at) out.push_back(fs::path(folders.substr(at, end - at)) / kFileName);
      at = end + 1;
    }
  }
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  if (!program.empty()) out.push_back(program / kFileName);
  out.push_back(fs::path(FACET_MODULE_BUILD_DIR) / kFileName);
  if (!program.empty()) {
    for (const char* lib : {FACET_MODULE_INSTALL_DIR, "lib/" FACET_MODULE_ARCHITECTURE "/facet", "lib/facet"}) {
      out.push_back((program.parent_path() / lib / kFileName).lexically_normal());
    }
  }
  out.emplace_back(kFileName);
  return out;
}

Image DecodeWithOiio(std::span<const std::byte> bytes, std::string_view extension, const std::string& name,
                     bool as_stored) {
  const Module module = GetFor(name, "not one of " + FormatsOfFacet(/*writing=*/false) + "; ");
  FacetOiioPicture picture{};
  char message[kMessageSize] = {};
  // For the module's pixels and their copy.
  const std::uint64_t most = MemoryBudget::Current().Left() / 2;
  const int result = module.decode(bytes.data(), bytes.size(), std::string(extension).c_str(), kMaxImageSide,
                                   kMaxImagePixels, most, as_stored, &picture, message, sizeof message);
  const std::unique_ptr<void, FacetOiioFree> owner(picture.pixels, module.free);
  if (result != FACET_OIIO_OK) throw Error(CodeOf(result), message, name);
  const MemoryLease lease(picture.size, 2, "decoded images", name);
  Image image;
  image.width = picture.width;
  image.height = picture.height;
  image.channels = picture.channels;
  image.type = static_cast<ChannelType>(picture.type);
  image.encoding = static_cast<Encoding>(picture.encoding);
  image.bytes = AllocatePixels(picture.size, name);
  std::memcpy(image.bytes.data(), picture.pixels, picture.size);
  return image;
}

std::vector<std::byte> EncodeWithOiio(const std::string& extension, const Image& image, bool premultiplied,
                                      const std::vector<std::array<std::string, 2>>& text) {
  const Module module = GetFor({}, "only " + FormatsOfFacet(/*writing=*/true) + " are written without OpenImageIO, and ");
  FacetOiioPicture picture{};
  picture.width = image.width;
  picture.height = image.height;
  picture.channels = image.channels;
  picture.type = static_cast<std::int32_t>(image.type);
  picture.encoding = static_cast<std::int32_t>(image.encoding);
  picture.pixels = const_cast<std::byte*>(image.bytes.data());  // the structure is also used for reading
  picture.size = image.bytes.size();
  char message[kMessageSize] = {};
  void* bytes = nullptr;
  std::size_t size = 0;
  std::vector<FacetOiioText> entries;
  for (const auto& [keyword, value] : text) entries.push_back({keyword.c_str(), value.c_str()});
  const int result = module.encode(extension.c_str(), &picture, premultiplied, entries.data(), entries.size(), &bytes,
                                   &size, message, sizeof message);
  const std::unique_ptr<void, FacetOiioFree> owner(bytes, module.free);
  if (result != FACET_OIIO_OK) throw Error(CodeOf(result), message);
  const auto* const begin = static_cast<const std::byte*>(bytes);
  return {begin, begin + size};
}

void OverrideOiioSearch(const std::vector<std::filesystem::path>* folders) {
  const std::lock_guard lock(mutex);
  search_override = folders;
}

}  // namespace facet
