#include "render/picture/whole/compose.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/spheres/layer.hpp"
#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {

namespace {

constexpr std::uint32_t kGhost = 90;  // strength of a ghost, of 255

void lay_row(const Layer& layer, int y, std::uint32_t* out, std::uint32_t strength = 255) {
    const Layer::Span span = layer.spans[static_cast<std::size_t>(y)];
    lay_over(out + span.begin, layer.row(y) + span.begin, span.end - span.begin, strength);
}

}  // namespace

void compose(const Layers& layers, const Rectangle& port, Picture& picture, Team& team) {
    team.run([&](int member) {
        for (int y = member; y < port.height; y += team.size()) {
            auto* out = reinterpret_cast<std::uint32_t*>(picture.pixel(port.x, port.y + y));
            std::fill_n(out, port.width, layers.background);
            if (layers.ground) layers.ground->shade(y, out);
            lay_row(layers.behind, y, out);
            if (layers.meshes_behind) lay_row(*layers.meshes_behind, y, out);
            const std::uint32_t strength =
                layers.strengths.empty() ? 255 : layers.strengths[static_cast<std::size_t>(y)];
            lay_row(layers.grains, y, out, strength);
            if (layers.ghosts) lay_row(*layers.ghosts, y, out, kGhost * strength / 255);
            if (layers.meshes_before) lay_row(*layers.meshes_before, y, out);
            lay_row(layers.before, y, out);
            if (layers.marks) lay_row(*layers.marks, y, out);
        }
    });
}

namespace {

constexpr std::uint32_t kMost = 0xffff;  // of linear light; and of moments, which the sums have room for

// The linear light of each sRGB byte, 16 bits.
const std::array<std::uint32_t, 256>& linear_of_byte() {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i)
            made[i] =
                static_cast<std::uint32_t>(std::lround(kMost * to_linear(static_cast<double>(i) / 255)));
        return made;
    }();
    return table;
}

}  // namespace

Exposure::Exposure(const Rectangle& port)
    : port_(port), sum_(static_cast<std::size_t>(port.width) * port.height * 4, 0) {}

void Exposure::add(const Picture& picture) {
    GRAINREEL_CHECK(count_ < kMost);
    const auto& linear = linear_of_byte();
    std::uint32_t* sum = sum_.data();
    for (int y = 0; y < port_.height; ++y) {
        const std::uint8_t* pixel = picture.pixel(port_.x, port_.y + y);
        for (int x = 0; x < port_.width; ++x, pixel += 4, sum += 4) {
            const std::uint32_t alpha = pixel[3];
            for (int c = 0; c < 3; ++c) sum[c] += (linear[pixel[c]] * alpha + 127) / 255;
            sum[3] += alpha;
        }
    }
    ++count_;
}

void Exposure::develop(Picture& picture) {
    GRAINREEL_CHECK(count_ > 0);
    const ToneTable& tone = ToneTable::get();
    const std::uint32_t* sum = sum_.data();
    for (int y = 0; y < port_.height; ++y) {
        std::uint8_t* pixel = picture.pixel(port_.x, port_.y + y);
        for (int x = 0; x < port_.width; ++x, pixel += 4, sum += 4) {
            const float alpha = static_cast<float>(sum[3]);
            const float scale = alpha > 0 ? 255.0f / (kMost * alpha) : 0.0f;
            for (int c = 0; c < 3; ++c)
                pixel[c] = static_cast<std::uint8_t>(tone.byte(scale * static_cast<float>(sum[c])));
            pixel[3] = static_cast<std::uint8_t>((sum[3] + count_ / 2) / count_);
        }
    }
    std::fill(sum_.begin(), sum_.end(), 0);
    count_ = 0;
}

}  // namespace grainreel
