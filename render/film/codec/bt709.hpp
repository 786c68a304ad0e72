// Converts sRGB pixels to what a video codec stores: Y'CbCr of ITU-R BT.709-6 in limited range, with half the
// chroma samples in each direction. It takes half the time of swscale, rounds to the nearest code, and
// computes chroma at the places that the film's file states (see to_bt709). It computes with integers alone,
// so the bits are the same with every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/picture/base/picture.hpp"

namespace grainreel {

struct YuvPlanes {
    std::uint8_t *y, *cb, *cr;
    std::ptrdiff_t y_stride, cb_stride, cr_stride;  // bytes from one row to the next
};

// Converts a picture of even width and height; alpha is left out. A chroma sample lies on the left one of two
// columns, halfway between two rows (H.273, Chroma420SampleLocType 0). It is the mean of both rows, and of
// three columns with weights 1 : 2 : 1; at the left edge the first column stands in for the one before it.
// Every code is within 0.51 of the formula's value.
void to_bt709(const Picture& picture, const YuvPlanes& to);
// Converts a part of the picture. It writes the codes of that part, and of the pixels beside it whose chroma
// depends on it.
void to_bt709(const Picture& picture, const Rectangle& part, const YuvPlanes& to);

}  // namespace grainreel
