// URIs as glTF uses them: relative references and data URIs (RFC 3986, RFC 2397, RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/input_file.h"

namespace facet::gltf {

// "%20" to " ". A percent sign that is not followed by two hexadecimal digits stands for itself.
std::string PercentDecode(std::string_view text);

bool IsDataUri(std::string_view uri);

// The bytes that a data URI holds (base64, or percent-encoded text); nothing when it is malformed. They are charged to
// the memory budget. Throws Error(OutOfMemory).
std::optional<Bytes> DecodeDataUri(std::string_view uri);

// Whether it can be seen without decoding that a data URI is malformed.
bool IsMalformedDataUri(std::string_view uri);

// Standard or URL-safe alphabet, padding optional, blanks and line breaks ignored; nothing when it is malformed.
// Charges and throws likewise.
std::optional<Bytes> DecodeBase64(std::string_view text);

// True for "http://...", "file:...": what names a scheme. A single letter is no scheme ("C:" is a Windows drive).
bool HasScheme(std::string_view uri);

}  // namespace facet::gltf
