// What passes between facet and its OpenImageIO module (facet_oiio.so): plain C, so that neither exceptions nor a
// library's types cross. The module keeps OpenImageIO's 261 shared libraries out of every start that needs none of
// them.
#pragma once

#include <stddef.h>
#include <stdint.h>

extern "C" {

#define FACET_OIIO_ABI_VERSION 2

// What a file says of itself.
struct FacetOiioText {
  const char* keyword;
  const char* value;
};

// width * height * channels interleaved numbers, top row first, no padding; alpha straight.
struct FacetOiioPicture {
  int32_t width, height, channels;
  int32_t type;      // facet::ChannelType
  int32_t encoding;  // facet::Encoding
  void* pixels;
  size_t size;  // bytes
};

enum FacetOiioResult {
  FACET_OIIO_OK = 0,
  FACET_OIIO_INVALID_INPUT = 1,
  FACET_OIIO_TOO_LARGE = 2,
  FACET_OIIO_OUTPUT_FAILED = 3,
  FACET_OIIO_UNSUPPORTED = 4,
};

// FACET_OIIO_ABI_VERSION of the module.
typedef int32_t (*FacetOiioAbiVersion)(void);

// Decodes a whole file in memory. `extension` chooses OpenImageIO's reader. More than max_bytes of decoded pixels are
// too large. as_stored: alpha stays associated where it is. On success `picture->pixels` belongs to the caller, who
// gives it back to FacetOiioFree. On failure `message` (message_size bytes, at least 1) is one line.
typedef int32_t (*FacetOiioDecode)(const void* bytes, size_t size, const char* extension, int32_t max_side,
                                   uint64_t max_pixels, uint64_t max_bytes, int32_t as_stored,
                                   FacetOiioPicture* picture, char* message, size_t message_size);

// A whole file in memory, of the format that `extension` names; `*bytes` belongs to the caller, as above.
// premultiplied: the picture's alpha is associated.
typedef int32_t (*FacetOiioEncode)(const char* extension, const FacetOiioPicture* picture, int32_t premultiplied,
                                   const FacetOiioText* text, size_t text_count, void** bytes, size_t* size,
                                   char* message, size_t message_size);

typedef void (*FacetOiioFree)(void* pixels);

}  // extern "C"
