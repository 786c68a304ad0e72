// The meshes of a scene, ready to be drawn where a frame has them, with their looks, paints and colours.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/mesh/mesh_painter.hpp"
#include "render/picture/mesh/mesh_projection.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// How a mesh looks: as film.walls says; otherwise as a vessel where grains are in it, or else by its shape.
MeshLook look_of(const FilmedScene& scene, const SceneMesh& mesh);

class SceneMeshes {
  public:
    explicit SceneMeshes(const FilmedScene& scene);

    bool any() const { return !drawn_.empty(); }
    // Colours the meshes by what the grains do to them in this frame, where the film wants it.
    void colour_by(const Frame& frame);
    // How many of the triangles that it has coloured lay beyond the range.
    const ClippedCount& clipped() const { return clipped_; }
    // The meshes where they are in a frame.
    const std::vector<DrawnMesh>& at(const Frame& frame);

  private:
    std::vector<DrawnMesh> drawn_;
    std::optional<ColourScale> scale_;  // where they have colours
    bool by_pressure_ = false;
    std::vector<std::size_t> mesh_;  // of the scene
    std::vector<std::vector<std::array<float, 3>>> colours_;
    ClippedCount clipped_;
    std::vector<std::size_t> body_;  // numbers
};

MeshPaints mesh_paints(const Palette& palette, const Vec3& up, int picture_height);
MeshPainter::Inks mesh_inks(const Palette& palette);

}  // namespace grainreel
