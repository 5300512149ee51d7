#include "image/exr.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "facet/error.h"
#include "image/limits.h"

namespace facet {

namespace {

// Reads values in little-endian order, which is the order of all machines that facet supports.
class Reader {
 public:
  Reader(std::string_view left, const std::string& name) : left_(left), name_(name) {}

  [[noreturn]] void CutOff() const { throw Error(ErrorCode::InvalidInput, "broken EXR: its header is cut off", name_); }

  // Reads text up to a zero byte.
  std::string_view Word() {
    const std::size_t end = left_.find('\0');
    if (end == std::string_view::npos) CutOff();
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(end + 1);
    return word;
  }

  template <class T>
  T Number() {
    T number;
    std::memcpy(&number, Take(sizeof number).data(), sizeof number);
    return number;
  }

  std::string_view Take(std::size_t size) {
    if (left_.size() < size) CutOff();
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }

  std::size_t Left() const { return left_.size(); }

 private:
  std::string_view left_;
  const std::string& name_;
};

struct Attribute {
  std::string_view name, type, value;
};

// Calls take(attribute) for the attributes of one part. False: there is none, which marks the end of a list of parts.
template <class Take>
bool ReadPart(Reader& reader, const Take& take) {
  for (bool any = false;; any = true) {
    Attribute attribute;
    attribute.name = reader.Word();
    if (attribute.name.empty()) return any;
    attribute.type = reader.Word();
    attribute.value = reader.Take(reader.Number<std::uint32_t>());
    take(attribute);
  }
}

// The bytes after the magic number, and whether the file may have several parts.
Reader Open(std::span<const std::byte> bytes, const std::string& name, bool* several) {
  constexpr std::uint32_t kSeveralParts = 0x1000;
  Reader reader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  reader.Take(4);
  *several = (reader.Number<std::uint32_t>() & kSeveralParts) != 0;
  return reader;
}

// OpenEXR reads values of these types by their own lengths and ignores the length in the header. If the two differ, it
// would interpret the following bytes differently from this check.
struct TypeSize {
  std::string_view type;
  std::size_t size;
};
constexpr TypeSize kSizes[] = {{"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
                               {"compression", 1}, {"double", 8},   {"envmap", 1},
                               {"float", 4},       {"int", 4},      {"keycode", 28},
                               {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
                               {"m44d", 128},      {"m44f", 64},    {"rational", 8},
                               {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
                               {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
                               {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1}};

// The size by which OpenEXR allocates memory, from an attribute's value.
void CheckAttribute(const Attribute& attribute, std::size_t file_size, const std::string& name) {
  Reader value(attribute.value, name);
  for (const auto& [type, size] : kSizes) {
    if (attribute.type == type && attribute.value.size() != size) value.CutOff();
  }
  if (attribute.name == "dataWindow" && attribute.type == "box2i") {
    const auto left = value.Number<std::int32_t>(), top = value.Number<std::int32_t>();
    const auto right = value.Number<std::int32_t>(), bottom = value.Number<std::int32_t>();
    const std::int64_t width = std::int64_t{right} - left + 1, height = std::int64_t{bottom} - top + 1;
    CheckImageSize(static_cast<std::uint64_t>(std::max<std::int64_t>(width, 0)),
                   static_cast<std::uint64_t>(std::max<std::int64_t>(height, 0)), name);
  } else if (attribute.type == "tiledesc") {
    const auto width = value.Number<std::uint32_t>(), height = value.Number<std::uint32_t>();
    CheckImageSize(width, height, name);
  } else if (attribute.name == "chunkCount" && attribute.type == "int") {
    // Each chunk has an 8-byte entry in the file's offset table.
    if (value.Number<std::uint32_t>() > file_size / 8) value.CutOff();
  } else if (attribute.type == "preview") {
    const std::uint64_t width = value.Number<std::uint32_t>(), height = value.Number<std::uint32_t>();
    if (value.Left() % 4 != 0 || width * height != value.Left() / 4) value.CutOff();
  } else if (attribute.type == "chlist") {
    while (!value.Word().empty()) value.Take(16);
    if (value.Left() > 0) value.CutOff();
  } else if (attribute.type == "stringvector") {
    while (value.Left() > 0) value.Take(value.Number<std::uint32_t>());
  }
}

}  // namespace

std::map<std::string, std::string> ReadExrText(std::span<const std::byte> bytes, const std::string& name) {
  bool several = false;
  Reader reader = Open(bytes, name, &several);
  std::map<std::string, std::string> texts;
  ReadPart(reader, [&](const Attribute& attribute) {
    if (attribute.type == "string") texts.emplace(attribute.name, attribute.value);
  });
  return texts;
}

void CheckExrHeader(std::span<const std::byte> bytes, const std::string& name) {
  bool several = false;
  Reader reader = Open(bytes, name, &several);
  const auto check = [&](const Attribute& attribute) { CheckAttribute(attribute, bytes.size(), name); };
  while (ReadPart(reader, check) && several) {
  }
}

}  // namespace facet
