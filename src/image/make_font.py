#!/usr/bin/env python3
"""Writes font_6x13.h: the printable ASCII characters of the X11 font 6x13, which is in the public domain.

    src/image/make_font.py /usr/share/fonts/X11/misc/6x13.pcf.gz > src/image/font_6x13.h

Needs python3-pil; the font is in Debian's package xfonts-base."""
import gzip
import io
import sys

from PIL import PcfFontFile

WIDTH, HEIGHT, ASCENT = 6, 13, 11
font = PcfFontFile.PcfFontFile(io.BytesIO(gzip.open(sys.argv[1]).read()))
print("""// The printable ASCII characters of the X11 font 6x13, which is in the public domain. Made by make_font.py.
#pragma once

#include <cstdint>

namespace facet {

inline constexpr int kFontWidth = 6, kFontHeight = 13;
// Characters 32 to 126: rows from the top, whose highest of 6 bits is the leftmost pixel.
inline constexpr std::uint8_t kFont[95][kFontHeight] = {""")
for code in range(32, 127):
    _, (x0, y0, _, _), _, bitmap = font.glyph[code]
    rows = [0] * HEIGHT
    for y in range(bitmap.size[1]):
        for x in range(bitmap.size[0]):
            row, column = ASCENT + y0 + y, x0 + x
            if bitmap.getpixel((x, y)) and 0 <= row < HEIGHT and 0 <= column < WIDTH:
                rows[row] |= 1 << (WIDTH - 1 - column)
    print("    {" + ", ".join(str(r) for r in rows) + "},")
print("};\n\n}  // namespace facet")
