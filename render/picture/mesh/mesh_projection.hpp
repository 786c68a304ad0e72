// Meshes as the camera sees them at one moment: solid and glass triangles and the lines along their edges, in
// pixels, sorted into bands of rows.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/base/team.hpp"
#include "engine/state/body.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/mesh/mesh_shape.hpp"
#include "render/picture/mesh/screen_setup.hpp"

namespace grainreel {

struct DrawnMesh {
    std::shared_ptr<const MeshShape> shape;
    BodyPose pose;
    // sRGB, 0 to 255, of each triangle where a quantity is shown on it; null: as walls look.
    const std::vector<std::array<float, 3>>* colours = nullptr;
};

// sRGB, 0 to 255.
struct MeshPaints {
    std::array<float, 3> dark, lit;  // of solid walls, turned away from the light and towards it
    Vec3 up{0, 0, 1};                // unit, where the light of the sky comes from
    float pen = 1;                   // pixels, the width of a main line
};

class MeshProjection {
  public:
    static constexpr int kBand = 16;  // rows

    void take(const View& view, const Sight& sight, const Cut& cut, const std::vector<DrawnMesh>& meshes,
              const MeshPaints& paints, Team& team);

    // Of numbers 1 on: the plane that a solid triangle lies in, its normal towards the eye. View coordinates.
    struct Plane {
        Eigen::Vector3f normal;
        float distance;
    };
    const Plane& plane(std::uint32_t number) const { return planes_[number - 1]; }
    // What there is in each band, by rising number.
    struct Band {
        std::vector<std::uint32_t> solid, glass, lines;
    };
    const std::vector<Band>& bands() const { return bands_; }
    const ScreenTriangle& solid(std::uint32_t i) const { return solid_[i]; }
    const ScreenTriangle& glass(std::uint32_t i) const { return glass_[i]; }
    const ScreenLine& line(std::uint32_t i) const { return lines_[i]; }
    bool empty() const { return solid_.empty() && glass_.empty() && lines_.empty(); }

  private:
    using Face = MeshShape::Face;
    // A triangle as the eye sees it.
    struct Seen {
        Face face;
        bool front;
        float cosine;  // of the angle between its normal and the line of sight, > 0
    };
    // What one thread makes.
    struct Share {
        std::vector<ScreenTriangle> solid, glass;
        std::vector<Plane> planes;
        std::vector<ScreenLine> lines;
    };

    void take_mesh(const DrawnMesh& mesh, Team& team);
    void add_triangle(const DrawnMesh& mesh, std::size_t t, Share& share);
    void add_piece(const DrawnMesh& mesh, std::size_t t, const Seen& seen, const Piece& piece, Share& share);
    void add_edge(const MeshShape::Edge& edge, Share& share) const;
    void join(std::vector<Share>& shares);
    void sort_into_bands();
    Seen look_at(const MeshShape& shape, std::size_t t) const;
    float lit(const Eigen::Vector3f& normal) const;

    // Of the moment that is taken.
    Sight sight_;
    DrawnSpace space_;
    PortSize port_{1, 1};
    MeshPaints paints_;
    Eigen::Matrix3f turn_;  // of the mesh at hand, from rest into the view
    Eigen::Vector3f up_;    // against gravity's usual direction, in the view
    std::vector<Eigen::Vector3f> vertices_;
    std::vector<char> whole_;  // a vertex: within the drawn space
    std::vector<Seen> seen_;

    std::vector<ScreenTriangle> solid_, glass_;
    std::vector<Plane> planes_;
    std::vector<ScreenLine> lines_;
    std::vector<Band> bands_;
};

}  // namespace grainreel
