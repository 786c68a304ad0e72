#include "render/picture/whole/compose.hpp"

#include <algorithm>

#include "render/picture/spheres/lay_over.hpp"

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

}  // namespace grainreel
