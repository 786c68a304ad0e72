// The meshes of a scene, ready to be drawn where a frame has them, with their looks, paints and colours. Also
// here: how far they reach in the course of a run, and how much light they take from the ground.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/mesh/mesh_painter.hpp"
#include "render/picture/mesh/mesh_projection.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// How a mesh looks. film.walls decides. Without it, the container's mesh and a mesh around the place where
// grains start are vessels, and the shape decides for all others.
MeshLook look_of(const FilmedScene& scene, const SceneMesh& mesh);

class SceneMeshes {
  public:
    explicit SceneMeshes(const FilmedScene& scene);

    bool any() const { return !drawn_.empty(); }
    // Colours the meshes by the pressure or the wear of this frame, if the film asks for it.
    void colour_by(const Shot& frame);
    // How many of the triangles that it has coloured lay beyond the range.
    const ClippedCount& clipped() const { return clipped_; }
    // The meshes where they are in a frame.
    const std::vector<DrawnMesh>& at(const State& frame);

  private:
    std::vector<double> shared(std::size_t mesh, std::vector<double> values) const;
    void blend(std::size_t mesh, const std::vector<double>& values);

    std::vector<DrawnMesh> drawn_;
    std::optional<ColourScale> scale_;  // set where meshes have colours
    bool by_pressure_ = false;
    std::vector<std::size_t> mesh_;  // numbers of the scene's meshes
    std::vector<std::vector<std::array<float, 3>>> colours_;
    std::vector<std::vector<DrawnMesh::CornerColours>> corner_colours_;
    ClippedCount clipped_;
    std::vector<std::size_t> body_;  // numbers of their bodies
    // Where meshes have colours: for each triangle, those over which its value is shared, and its area (m2).
    std::vector<std::vector<std::vector<std::uint32_t>>> neighbours_;
    // For the three corners of each triangle whose colours blend, the triangles around them; else empty.
    using Corners = std::array<std::vector<std::uint32_t>, 3>;
    static std::vector<Corners> around_corners(const MeshShape& shape,
                                               const std::vector<std::int32_t>& patch);
    std::vector<std::vector<Corners>> around_;
    std::vector<std::vector<double>> areas_;
};

MeshPaints mesh_paints(const Palette& palette, const Vec3& up, int picture_height);
MeshPainter::Inks mesh_inks(const Palette& palette);

// m: the outermost points of all meshes together along many directions, at rest and wherever their turns and
// paths bring them. Steady velocities, which have no end, and the drive are left out. Empty without meshes.
std::vector<Vec3> mesh_reach(const FilmedScene& scene);

// The surfaces of meshes as small patches that throw shadows. A vessel lets most of the light through, as all
// walls do.
class MeshShadows {
  public:
    explicit MeshShadows(const FilmedScene& scene);

    bool any() const { return !patches_.empty(); }
    double lowest() const { return lowest_; }  // m, lowest z of any mesh without the drive; 0 without meshes

    // Calls visit(place, area) for each patch, with the area (m2) that it takes from light that comes from
    // `to_light`.
    template <class Visit>
    void visit(const State& frame, const Vec3& to_light, const Visit& visit) const {
        for (const Patch& patch : patches_) {
            const BodyPose pose = frame.body(patch.body);
            visit(pose.moved(patch.at), std::abs(to_light.dot(pose.rotation * patch.area)));
        }
    }

  private:
    struct Patch {
        Vec3 at;    // m, at rest
        Vec3 area;  // m2, along its normal, times the share of the light that it takes
        std::size_t body;
    };
    // along: how many patches are wanted along each side.
    void add(const Surface& surface, std::int32_t t, double along, double share, std::size_t body);

    std::vector<Patch> patches_;
    double lowest_ = 0;
};

}  // namespace grainreel
