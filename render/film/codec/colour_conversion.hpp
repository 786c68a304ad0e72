// From drawn pixels to what a codec stores: sRGB to BT.709 Y'CbCr, limited range, chroma halved both ways; or
// the same RGB in another order.
#pragma once

#include "render/film/codec/ffmpeg_handles.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

struct EvenSize {
    int width = 0, height = 0;  // pixels
};

// Where the chroma is halved an odd width or height grows by one.
EvenSize coded_size(int width, int height, AVPixelFormat pixels);

class ColourConversion {
  public:
    // Size of the pictures, pixels. Where the coded size is larger the last column or row is repeated.
    // pixels: yuv420p, bgr0, bgra, or pal8, for which there is nothing to convert here.
    ColourConversion(int width, int height, AVPixelFormat pixels = AV_PIX_FMT_YUV420P);

    int coded_width() const { return coded_.width; }
    int coded_height() const { return coded_.height; }

    // `target`: of the coded size, writable; it holds the picture converted before, if there is one.
    void convert(const Picture& picture, AVFrame& target);

  private:
    const Picture& even(const Picture& picture);

    int width_, height_;
    EvenSize coded_;
    ScalerPtr scaler_;         // of the same RGB in another order
    Picture padded_;           // only used when a size is odd
    std::uint64_t still_ = 0;  // of the picture converted before
};

}  // namespace grainreel
