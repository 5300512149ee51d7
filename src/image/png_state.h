// libpng's state for one file. libpng reports errors by longjmp, which must not skip destructors: functions that call
// setjmp have plain data only, and the functions that own memory call them.
#pragma once

#include <png.h>

#include <csetjmp>
#include <cstdio>

#include "facet/error.h"

namespace facet {

struct PngComplaint {
  char text[160] = {};
  char warning[160] = {};  // the first
};

struct PngState {
  enum class For { Reading, Writing };

  PngComplaint complaint;
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit PngState(For use) : use_(use) {
    const auto create = use == For::Reading ? png_create_read_struct : png_create_write_struct;
    png = create(PNG_LIBPNG_VER_STRING, &complaint, OnError, OnWarning);
    if (png) info = png_create_info_struct(png);
    if (!info) throw Error(ErrorCode::OutOfMemory, "no memory for libpng");
  }
  ~PngState() {
    if (use_ == For::Reading) {
      png_destroy_read_struct(&png, &info, nullptr);
    } else {
      png_destroy_write_struct(&png, &info);
    }
  }
  PngState(const PngState&) = delete;
  PngState& operator=(const PngState&) = delete;

 private:
  static void OnError(png_structp png, png_const_charp message) {
    auto* complaint = static_cast<PngComplaint*>(png_get_error_ptr(png));
    std::snprintf(complaint->text, sizeof complaint->text, "%s", message);
    png_longjmp(png, 1);
  }

  static void OnWarning(png_structp png, png_const_charp message) {
    auto* complaint = static_cast<PngComplaint*>(png_get_error_ptr(png));
    if (complaint->warning[0] == '\0') std::snprintf(complaint->warning, sizeof complaint->warning, "%s", message);
  }

  For use_;
};

}  // namespace facet
