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

// Decodes a data URI (base64, or percent-encoded text); nothing if it is malformed. The bytes are charged to the memory
// budget. Throws Error(OutOfMemory).
std::optional<Bytes> DecodeDataUri(std::string_view uri);

// Whether a data URI is malformed, as far as that is visible without decoding.
bool IsMalformedDataUri(std::string_view uri);

// Decodes base64 in the standard or URL-safe alphabet; padding is optional, blanks and line breaks are ignored. Nothing
// if it is malformed. Charges memory and throws in the same way.
std::optional<Bytes> DecodeBase64(std::string_view text);

// Whether a URI has a scheme, like "http://..." or "file:...". A single letter is not a scheme ("C:" is a Windows
// drive).
bool HasScheme(std::string_view uri);

}  // namespace facet::gltf
