// From sRGB pixels to what a video codec stores: Y'CbCr of ITU-R BT.709-6 in limited range, chroma halved
// both ways. Our own in place of swscale's: half the time, rounded to the nearest code, and chroma
// where the film says it is. Integers only: the same bits with every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/picture/base/picture.hpp"

namespace grainreel {

struct YuvPlanes {
    std::uint8_t *y, *cb, *cr;
    std::ptrdiff_t y_stride, cb_stride, cr_stride;  // bytes a row
};

// Picture of even width and height, alpha left out. Chroma sits halfway between two rows on the left one of
// two columns (H.273, Chroma420SampleLocType 0) and is the mean of both rows, and of the columns with 1 : 2 :
// 1, of which the first stands in for the one before it. Within 0.51 of a code of the formula.
void to_bt709(const Picture& picture, const YuvPlanes& to);
// The same for a part of it, whose codes alone are written, and those of the pixels beside it that it shows
// in.
void to_bt709(const Picture& picture, const Rectangle& part, const YuvPlanes& to);

}  // namespace grainreel
