#include "render/film/codec/colour_conversion.hpp"

#include <algorithm>
#include <cstring>

#include "engine/base/error.hpp"
#include "render/film/codec/bt709.hpp"

namespace grainreel {

EvenSize coded_size(int width, int height, AVPixelFormat pixels) {
    if (pixels != AV_PIX_FMT_YUV420P) return {width, height};
    return {width + width % 2, height + height % 2};
}

ColourConversion::ColourConversion(int width, int height, AVPixelFormat pixels)
    : width_(width), height_(height), coded_(coded_size(width, height, pixels)) {
    if (coded_width() > width || coded_height() > height) padded_ = Picture(coded_width(), coded_height());
    if (pixels == AV_PIX_FMT_PAL8 || pixels == AV_PIX_FMT_YUV420P) return;
    scaler_.reset(sws_getContext(width, height, AV_PIX_FMT_RGBA, width, height, pixels, SWS_POINT, nullptr,
                                 nullptr, nullptr));
    if (!scaler_) throw RunError("film: this libswscale does not convert from RGBA");
}

const Picture& ColourConversion::even(const Picture& picture) {
    if (padded_.width == 0) return picture;
    for (int y = 0; y < padded_.height; ++y) {
        const int from = std::min(y, height_ - 1);
        std::memcpy(padded_.pixel(0, y), picture.pixel(0, from), static_cast<std::size_t>(width_) * 4);
        if (padded_.width > width_) std::memcpy(padded_.pixel(width_, y), picture.pixel(width_ - 1, from), 4);
    }
    return padded_;
}

void ColourConversion::convert(const Picture& picture, AVFrame& target) {
    GRAINREEL_CHECK(picture.width == width_ && picture.height == height_);
    const Picture& source = even(picture);
    if (target.format == AV_PIX_FMT_YUV420P) {
        const YuvPlanes planes{target.data[0],     target.data[1],     target.data[2],
                               target.linesize[0], target.linesize[1], target.linesize[2]};
        if (picture.still != 0 && picture.still == still_) {
            for (const Rectangle& part : picture.moving) to_bt709(source, part, planes);
        } else {
            to_bt709(source, planes);
        }
        still_ = picture.still;
        return;
    }
    GRAINREEL_CHECK(scaler_);
    const std::uint8_t* planes[4] = {source.rgba.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {source.width * 4, 0, 0, 0};
    sws_scale(scaler_.get(), planes, strides, 0, source.height, target.data, target.linesize);
}

}  // namespace grainreel
