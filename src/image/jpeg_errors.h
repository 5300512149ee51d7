// Error handling for libjpeg. Its own handler ends the process; this one calls longjmp, which must not skip
// destructors: functions that call setjmp have plain data only, and the functions that own memory call them.
#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdio>

// jpeglib.h needs size_t and FILE to be known.
#include <jpeglib.h>

#include <jerror.h>

namespace facet {

struct JpegErrors {
  jpeg_error_mgr manager;  // first: libjpeg hands back a pointer to it
  std::jmp_buf jump;
  char text[JMSG_LENGTH_MAX];
  bool ended_early;  // the end marker of the file is missing
};

[[noreturn]] inline void OnJpegError(j_common_ptr codec) {
  auto* errors = reinterpret_cast<JpegErrors*>(codec->err);
  codec->err->format_message(codec, errors->text);
  std::longjmp(errors->jump, 1);
}

// What a codec's `err` is set to.
inline jpeg_error_mgr* BeginJpegErrors(JpegErrors& errors) {
  jpeg_std_error(&errors.manager);
  errors.manager.error_exit = OnJpegError;
  errors.manager.output_message = [](j_common_ptr) {};
  return &errors.manager;
}

}  // namespace facet
